"""A case as arrays for the kernels: mesh, coordinates, the data of every term, the loading."""
