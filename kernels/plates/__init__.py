"""Walls as plates in space: shells with a position and a director at every node.

`rotation` has the directors, `layers` the energy of a layered wall over its strain measures,
`bow` the arcs between nodes, `shear` the energy of transverse shear, `shell` the element that these
form. The material is a sheet
(`kernels.laws.sheet`).
"""
