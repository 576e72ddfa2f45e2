"""A case as arrays for the kernels: mesh, coordinates, the data of every term, and the loading.

`lattice`, `sides`, `periodic` and `custom` each build one kind of scene out of the same parts:
`mesh` divides the walls, `joints` (with `joint_kinds`) says how they end, `coordinates` what moves,
`images` what follows the nodes of a period. `beams`, `bending`, `contact` and `material` (with
`relaxation`) have the data of the terms, which `terms` puts together. `loading` has the stages,
`arc_length` the data of that method. `plates` is the same for a lattice that is pressed along its
cells.
"""
