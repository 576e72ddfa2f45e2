"""The factor of a lattice of plates (`kernels.plates`): LDL^T by dense panels.

It is one of any sparse symmetric matrix of blocks of 1 to 6 unknowns. `dissection` and the minimum
degree order the blocks, `symbolic` gathers the columns of the factor in supernodes, `analysis` lays
out a `matrix`, `fronts` assembles a supernode with what its children leave, `dense` has the
arithmetic of panels, and `factor` and `solution` use them.
"""
