"""Sheets that divide space into two equal parts: level surfaces of periodic functions.

`level_set` has the functions, `nets` a net of quads on one of them between two planes, `net_quality`
what its quads look like.
"""
