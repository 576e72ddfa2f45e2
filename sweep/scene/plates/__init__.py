"""A case that is pressed along its cells, as arrays: upright walls on a grid of quads.

`mesh` divides the walls, `imperfection` bows them, `coordinates` says what moves, `contact` and
`law` have the data of these terms; `scene` puts all together. `unfolded` makes a whole lattice from
a quarter. The plan of the walls is that of the lattice in the plane (`design.upright_plan`).
"""
