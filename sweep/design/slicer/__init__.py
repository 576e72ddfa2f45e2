"""Lattices as slicers print them, not as they are drawn.

`patterns` has the width and the spacing (distance) of lines for a share of infill, `network` the
walls: the infill within a box of perimeters, as a network of `design`; `joining` joins lines to the
outline.
"""
