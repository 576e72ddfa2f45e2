"""What a user writes: tables of keys with units, read from TOML into the cases of a sweep.

`tables` lists the keys of a case with their fixed defaults, `reader` and `units` read them into SI,
`grid` expands them. `resolve` and `solver_defaults` fill in the defaults that depend on the case.
"""
