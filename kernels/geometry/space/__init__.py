"""Geometry in space: distances of nodes, edges and triangles, near pairs, crossing surfaces.

`near` is the broad phase, `closest` finds the closest points of a pair, `derivatives` has the
derivatives of their distance, `advancement` limits a move so that nothing touches, and `crossing`
finds crossings in a stored shape. `parallel` takes parallel edges out of contact, `surface` has the
edges and areas of triangulated surfaces, and `vectors` the arithmetic. A node has `vectors.SIZE`
coordinates; the first three are its position in m.
"""
