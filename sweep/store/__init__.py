"""Results as HDF5: sealed parts that survive any end of a sweep, folded into one file.

`write` and `read` are its two sides; the only home of h5py.
"""
