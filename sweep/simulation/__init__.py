"""Simulates a case and returns its result.

`simulate` runs the march, `time_limit` ends one that takes too long, `retries` repeats a case that
stops, and `failures` has the messages of cases that do not finish. `summary` measures a crush, with
`between_rows`, `densification`, `iso_13314`, `base_load`, `striker`, `deceleration`, `cycles`,
`up_to_force` and `solid`; `time_resolution` estimates the errors of time steps. `shape_checks` and
`plate_shapes` measure stored shapes, `custom_history` records the probes of a custom structure.
"""
