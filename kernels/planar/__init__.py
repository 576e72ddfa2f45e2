"""The planar lattice as a problem of the solver: walls with two coordinates a node, and joints.

`problem` has its data and lists its verbs: `potential` sums the energy, `factoring` the matrix
(`couplings` lists what is coupled outside of walls), `reach` limits a move, `constraints` leads
what is driven, `steps` begins and commits a step, with the memory of the material.
`position_based` is the contact of the course report.
"""
