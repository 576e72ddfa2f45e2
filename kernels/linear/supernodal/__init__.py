"""The factor of a lattice of plates (`kernels.plates`): LDL^T by dense panels.

It works for any sparse symmetric matrix with blocks of 1 to 6 unknowns. `dissection` and the
minimum degree order the blocks, `symbolic` groups the columns of the factor into supernodes,
`analysis` lays out a `matrix`, `fronts` assembles a supernode with the updates of its children,
`dense` has the arithmetic of panels, and `factor` and `solution` use them.
"""
