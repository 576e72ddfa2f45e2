"""A user's own test of a printed strip or puck, and the material that follows from it.

`record` reads the test, `legs` divides it into loading, unloading and reloading. `fit` finds the
loss and the softening of the material, `curve` its stresses over strain; `write` makes a file of a
material from them.
"""
