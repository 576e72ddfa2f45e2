"""The linear system of a Newton step.

`analysis` numbers the unknowns once, `bundles` gathers walls that are alike, `condense` eliminates
the inside of four at a time, `block_ldlt` factors the 3 x 3 blocks that remain, and `system` does
all of it in order. `supernodal` factors larger matrices, of nodes in space.
"""
