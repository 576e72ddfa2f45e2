"""A sweep: cases in batches on Dask, progress, error bars, cost estimate. The only user of dask."""
