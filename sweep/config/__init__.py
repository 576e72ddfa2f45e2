"""What a user writes: tables of keys with units, read from TOML into the cases of a sweep.

`tables` lists the keys of a case, `reader` and `units` read them into SI, `grid` expands them, and
`resolve` fills in what a case leaves open.
"""
