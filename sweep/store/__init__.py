"""Results as HDF5: sealed parts that survive any end of a sweep, folded into one file.

`write` decides when, `hdf5` writes the columns of a file, `read` reads them; `batch` and `tables`
are in memory. `hdf5` and `read` are the only home of h5py.
"""
