"""A sweep: cases in batches on Dask, progress, error bars, the estimate; the only dask."""
