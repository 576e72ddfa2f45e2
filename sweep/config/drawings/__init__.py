"""Reads drawings of lattices: lines in files of other programs, which become a network of walls.

`drawing_file` reads a file of any format: `tables` reads numbers (JSON, CSV, LAMMPS), `dxf` and
`svg` read lines and curves, which `curves` makes straight. `lines` holds the result.
"""
