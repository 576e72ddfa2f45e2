"""Geometry in space: distances of nodes, edges and triangles, near pairs, crossing surfaces.

`near` finds what is near, `closest` the closest points, `derivatives` those of their distance,
`advancement` how far a move may go, and `crossing` what has crossed in a stored shape. `parallel`
takes parallel edges out of contact, `surface` has the edges and areas of triangulated surfaces, and
`vectors` the arithmetic. A node has `vectors.SIZE` coordinates, of which the first three are its
position in m.
"""
