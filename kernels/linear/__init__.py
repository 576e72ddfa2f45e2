"""The linear system of a Newton step.

`condensed` serves walls in the plane (`kernels.planar`): it eliminates the inside of walls, then
factors 3 x 3 blocks. `supernodal` serves plates (`kernels.plates`): it factors the larger matrices
of nodes in space. Both order their unknowns by `minimum_degree`, and replace pivots that are zero
within round-off (`pivots`).
"""
