"""A sweep from its cases to its results file: batches on Dask, progress, error bars, estimates.

`dask_graph` is the only home of dask.
"""
