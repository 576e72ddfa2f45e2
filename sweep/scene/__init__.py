"""A case as arrays for the kernels: mesh, coordinates, the data of every term, and the loading.

`lattice`, `periodic` and `custom` each build one kind of scene out of the same parts (`terms`).
"""
