"""Walls as plates in space as a problem of the solver: upright walls pressed along the print axis.

`element` has the quad with a director at each node, `contacts` what touches and slides. As in
`kernels.planar`, `problem` has the data and lists the verbs, `potential` sums the energy,
`factoring` the matrix, `reach` limits a move, `steps` begins and commits. `layout` says where the
unknowns are in the matrix, `couplings` which of its blocks are needed, and `assembly` where the
entries of the Hessian go.
"""
