"""A sweep from its cases to its results file.

`sweep` runs what is missing: `batches` groups cases, `dask_graph` (the only home of dask) runs
them, `writer_thread` keeps results, `progress` reports how far a sweep is, `estimate` how long it
will take. `run` is the same for a user in Python. `beside` has runs that accompany a sweep,
`searching` the search for the best design.
"""
