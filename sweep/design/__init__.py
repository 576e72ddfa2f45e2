"""What is drawn: families of infill, the network of walls, and its printed area.

`infill` has one file for each family, which `drawing` stretches, clips and welds. `lattice` chooses
between the infill of a `box`, one `period` of what repeats, what a `slicer` prints, and what a user
has `drawn`, whose lines `meeting` makes walls; each is a `network` of walls by the numbers in
`geometry`. `silhouette` and `area` give the printed area, `sizing` the cells or the wall for a
mass, `panel` the specimens in a rectangle, `upright_plan` the plan of walls that are pressed along
their cells.
"""
