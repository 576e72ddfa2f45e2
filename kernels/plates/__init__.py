"""Walls as plates in space as a problem of the solver: upright walls pressed along the print axis.

The terms: `shell` is the element, of `layers` and `shear`, with directors of `rotation` and a sheet
(`kernels.laws.sheet`) as its material; `contact` and `friction` act between `pairs`. `problem` has
the data and lists the verbs, as `kernels.planar.problem` does for walls in the plane.
"""
