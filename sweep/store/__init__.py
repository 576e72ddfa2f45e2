"""Stores results as HDF5: sealed parts that survive any end of a sweep, folded into one file.

`write` decides when rows are written, `parts` names the sealed files, `hdf5` writes one,
`sealed_file` opens one, `read` reads all of them, and `lock` admits one writer at a time. `batch`
and `tables` hold rows in memory; `damage` finds damaged rows by their `checksum`. `hdf5` and
`sealed_file` are the home of h5py, which else only the export of shapes to ParaView uses; `errors`
has the one error.
"""
