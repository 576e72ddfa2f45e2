"""A user's own test of a printed strip or puck, and the material that follows from it.

`table` finds the numbers in the file of a testing machine, `columns` says which they are, `record`
makes a test of them, `legs` divides it into loading, unloading and reloading. `fit` finds the loss
and the softening of the material, `curve` its stresses over strain, `uncertainty` their standard
errors; `write` makes a file of a material from them.
"""
