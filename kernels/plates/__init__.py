"""Walls as plates in space as a problem of the solver: upright walls pressed along the print axis.

`element` has the quad with a director at each node, `contacts` what touches and slides. As in
`kernels.planar`, `problem` has the data and lists the verbs, `potential` sums the energy,
`factoring` the matrix (`assembly` says where its entries go), `reach` limits a move, `steps`
begins and commits.
"""
