"""What a user writes: tables of keys with units, read from TOML into the cases of a sweep.

`reading` takes a file apart, `units` reads quantities into SI, `keys` and `tables` list the keys
with their fixed defaults, `axis` and `grid` expand a grid, `case` is one case with its id.
`defaults` fills in what depends on the case; `materials` and `structures` read files of their own.
"""
