"""Plane geometry: distances and collision times, pairs of nodes and walls that are near.

`near_pairs` finds what is near, `distance` how near it is, `ccd` when it would meet, and `crossing`
what has crossed in a stored shape. `slabs` and `scanline` measure printed areas, both by
`intervals`, `specimen_height` the height of a lattice; `angle` is a fast arctangent. `space` is the
same for surfaces.
"""
