"""LDL^T factor of a sparse symmetric matrix of blocks of 1 to 6 unknowns, by dense panels.

`dissection` and the minimum degree order the blocks, `elimination` gathers the columns of the
factor in supernodes, `analysis` lays out a `matrix`, `fronts` assembles a supernode with what its
children leave, `dense` has the arithmetic of panels, and `factor` and `solution` use them.
"""
