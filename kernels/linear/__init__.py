"""The linear system of a Newton step.

`analysis` numbers the unknowns once, `condense` eliminates the inside of a wall, `block_ldlt`
factors the 3 x 3 blocks that remain, and `system` does all of it in order.
"""
