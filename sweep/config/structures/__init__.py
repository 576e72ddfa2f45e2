"""Reads custom structures from a JSON file.

`structure` has the keys of the file, `structure_file` reads it and lists its faults, and
`mechanism` finds motions that no support, spring or wall resists.
"""
