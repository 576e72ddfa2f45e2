"""Lattices as slicers print them, instead of as they are drawn.

`patterns` has the width and the spacing (distance) of lines for a share of infill, `network` the
walls: the infill within a box of perimeters, as in a network of `design`.
"""
