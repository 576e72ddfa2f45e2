"""A sweep from its cases to its results file.

`sweep` runs what is missing: `batches` groups cases, `dask_graph` (the only home of dask) runs
them, `alone` a single one in a process of its own, `journal` writes down which run at the moment,
`writer_thread` keeps results, with the attributes of `provenance`. `progress` reports how far a
sweep is, `estimate` how long it will take, `relaxation_warning` which cases are too short or too
long for their material, `period_note` which are one period of a panel. `run` is the same for a user
in Python. `beside` has runs that accompany a sweep, `searching` the search for the best design.
"""
