"""Verbs that the problems of walls in the plane and of plates share, whatever the dimension.

`followers` has coordinates that follow others, `lagging` says when friction is updated, `moves` how
far nodes move and whether a list of pairs still holds, and `rows` has rows and shapes of a history.
"""
