"""Simulates a case and returns its result.

`simulate` runs the march, `time_limit` ends one that takes too long, `retries` repeats a case that
stops, `failures` has the messages of cases that do not finish, and `warm_up` the cases that load
the kernels. `summary` measures a crush, with `between_rows`, `densification`, `iso_13314`,
`base_load`, `striker`, `filter_class`, `cycles`, `up_to_force` and `solid`; `load_step_error` and
`time_resolution` estimate the errors of load and time steps. `shape_checks` and `plate_shapes`
measure stored shapes, `custom_history` records the probes of a custom structure.
"""
