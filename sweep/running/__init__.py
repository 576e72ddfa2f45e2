"""A sweep from its cases to its results file.

`sweep` runs what is missing: `batches` groups cases, `threads` runs them here, `dask_graph` on the
workers of a `cluster` (these two are the only home of dask), `alone` suspect ones in a process of
their own. `warming` loads the kernels, `on_worker` is what a worker does, if it has the
`fingerprint` of the run. `journal` writes down which cases run at the moment, `writer_thread` keeps
results, with the attributes of `provenance`. `progress` reports how far a sweep is, `estimate` how
long it will take, `relaxation_warning` which cases are too short or too long for their material,
`period_note` which are one period of a panel. `run` is the same for a user in Python. `beside` has
runs that accompany a sweep, `searching` the search for the best design.
"""
