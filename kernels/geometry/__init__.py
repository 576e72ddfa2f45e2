"""Plane geometry: distances and collision times, pairs of nodes and walls that are near.

`near_pairs` is the broad phase, `distance` measures pairs, `ccd` finds when they would meet, and
`crossing` finds crossings in a stored shape. `slabs` and `scanline` measure printed areas, both by
`intervals`; `profile` has rigid profiles, `angle` an arctangent, and `specimen_height` the height
of a lattice. `space` is the geometry of plates.
"""
