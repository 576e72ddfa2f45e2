"""Builds the arrays of a case that is pressed along its cells: upright walls on a grid of quads.

`mesh` divides upright walls, `sheet` a periodic surface, both into a `shell_mesh`; `imperfection`
bows walls, `coordinates` says which coordinates move, `contact` and `law` have the data of these
terms; `scene` puts all together. `unfolded` makes a whole lattice from a quarter. The plan of the
walls is the lattice in the plane (`design.upright_plan`).
"""
