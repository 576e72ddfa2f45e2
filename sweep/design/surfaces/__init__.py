"""Sheets that divide space into two equal parts: level surfaces of periodic functions.

`names` has the sheets and where a panel may be cut from them, `level_set` the functions, `nets` a
net of quads between two planes, `panel` the nets of panels and blocks of a sheet.
"""
