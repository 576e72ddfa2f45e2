"""A case in, a result out.

`simulate` runs the march, `time_limit` ends one that takes too long, and `failures` has the
sentences of cases that do not finish. `summary` measures a crush, with `packing`, `iso_13314`,
`striker`, `deceleration`, `cycles` and `until`. `shape_checks` and `plate_shapes` measure stored
shapes, `custom_history` follows the probes of a custom structure.
"""
