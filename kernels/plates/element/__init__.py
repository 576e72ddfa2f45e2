"""The element of a wall pressed along its cells: a quad that stretches, bends, shears and folds.

`shell` has the quad; it asks `layers` for the material through the thickness, `shear` and
`relaxing_shear` for the shear across it, `bow` for the lengths of arcs in place of chords,
`rotation` for directors. `fold` keeps directors from turning over.
"""
