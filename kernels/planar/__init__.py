"""The planar lattice as a problem of the solver: walls with two coordinates per node, and joints.

`problem` has the data and lists the verbs: `potential` sums the energy, `factoring` factors the
Hessian (`couplings` lists the couplings outside of walls), `neighbour_lists` limits a move,
`constraints` moves driven and tied coordinates, `steps` begins and commits a step, with the memory
of the material. `position_based` is the contact of the course report, `base_pressure` measures
forces on the base.
"""
