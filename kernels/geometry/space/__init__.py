"""Geometry in space: distances of nodes, edges and triangles, near pairs, crossing surfaces.

A node has `vectors.SIZE` coordinates, of which the first three are its position in m.
"""
