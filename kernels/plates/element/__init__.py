"""The element of a wall pressed along its cells: a quad that stretches, bends, shears and folds.

`shell` has the quad. It uses `layers` for the material through the thickness, `shear` and
`relaxing_shear` for transverse shear, `bow` for the lengths of arcs in place of chords, `axes` for
quads that are no rectangles, and `rotation` for directors. `fold` keeps directors from turning
over.
"""
