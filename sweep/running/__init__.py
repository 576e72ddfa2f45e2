"""Runs the cases of a sweep and writes their results file.

`sweep` runs the missing cases: `batches` groups them, `threads` runs them in this process,
`processes` in others, `dask_graph` on the workers of a `cluster` (these two are the only home of
dask), and `child_process` runs suspect ones one at a time; `place` chooses between these.
`warming` loads the kernels, `memory` limits the memory of a case, `fingerprint` tells which workers
compute the same numbers. `journal` records which cases run at the moment, `writer_thread` stores
results, with the attributes of `provenance`. `progress` reports how far a sweep is, `estimate` how
long it will take, `case_notes` which cases are one period of a panel, or too short or too long for
their material; `applicable` refuses requirements that fit no case. `run` does the same for a user
of Python. `beside` has runs that accompany a sweep, `searching` the search for the best design.
"""
