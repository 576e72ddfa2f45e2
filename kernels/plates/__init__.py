"""Walls as plates in space as a problem of the solver: upright walls pressed along the print axis.

`element` has the quad with a director at each node, `contacts` the contact and friction of walls.
As in `kernels.planar`, `problem` has the data and lists the verbs, `potential` sums the energy,
`factoring` factors the Hessian, `neighbour_lists` limits a move, `steps` begins and commits a step.
`layout` says where the unknowns are in the matrix, `couplings` which blocks the matrix needs, and
`assembly` where the entries of the Hessian go.
"""
