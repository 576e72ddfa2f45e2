"""Drawings of lattices: lines in files of other programs, which become a network of walls.

`drawing_file` reads a file of any format: `tables` those of numbers (JSON, CSV, LAMMPS), `dxf` and
`svg` those of lines and curves, which `curves` makes straight.
"""
