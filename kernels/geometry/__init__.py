"""Plane geometry: distances and collision times, pairs of nodes and walls that are near.

`slabs`, `scanline` and `specimen_height` measure areas and extents of what is printed.
"""
