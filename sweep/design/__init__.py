"""Draws lattices: families of infill, the network of walls, and its printed area.

`infill` has one file for each family, which `drawing` stretches, clips and welds. `lattice` chooses
between the infill of a `box`, one `period` of a repeating lattice, the lattice of a `slicer`, and a
user's `drawn` lattice, whose lines `meeting` turns into walls; each is a `network` of walls defined
by the numbers in `geometry`. `surfaces` has the sheets, `profile` the rigid profiles that press a
lattice. `silhouette` and `area` give the printed area, `sizing` the cells or the wall for a mass,
`panel` the specimens in a rectangle, `upright_plan` the plan of walls that are pressed along their
cells.
"""
