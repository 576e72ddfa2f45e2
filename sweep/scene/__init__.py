"""Builds the arrays that the kernels need from a case: mesh, coordinates, data of all terms,
loading.

`lattice`, `sides`, `periodic` and `custom` each build one kind of scene from the same parts: `mesh`
divides the walls, `joints` (with `joint_kinds`) describes their ends, `coordinates` numbers the
coordinates, and `images` says which follow the nodes of a period. `beams`, `bending`, `contact` and
`material` (with `relaxation`) have the data of the terms, which `scene` puts together. `profiles`
replaces flat platens. `loading` has the stages, `arc_length` the data of the arc-length method.
`plates` does the same for a lattice that is pressed along its cells.
"""
