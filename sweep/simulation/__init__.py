"""A case in, a result out.

`simulate` runs the march. `summary` measures what came of it, with `packing`, `iso_13314`,
`striker`, `deceleration`, `cycles` and `until`; `shape_checks` looks for crossings,
`custom_history` follows probes, `time_limit` ends what takes too long.
"""
