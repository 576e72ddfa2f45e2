"""What a user writes: tables of keys with units, read from TOML into the cases of a sweep.

`reading` takes a file apart, `units` reads quantities into SI, `keys` lists the keys, which the
`tables` have with their fixed defaults. `lattice_table` and `material_table` are the long tables;
the former is checked by `lattice_limits`, and by `slicer_lines` if there is a slicer. `axis` and
`grid` expand a grid, `case` is one case with its id, and `network` has the walls of a case.
`defaults` fills in what depends on the case; `materials`, `structures`, `drawings` and `profiles`
read files of their own.
"""
