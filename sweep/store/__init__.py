"""Results as HDF5: parts that survive any end of a sweep, folded into one file; the only h5py."""
