"""From a case to arrays for the kernels: mesh, coordinates, data of every term, loading."""
