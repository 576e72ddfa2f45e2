"""Verbs that the problems of walls in the plane and of plates share, whatever the dimension.

`followers` has coordinates that follow others, `lagging` updates friction, `moves` says how far
nodes move and whether a list of pairs is still valid, and `rows` writes rows and shapes of a
history.
"""
