"""Results as HDF5: parts that survive a kill, folded into one file. The only user of h5py."""
