"""A user's own test of a printed strip or puck, and the material that follows from it.

`record` reads the test, `branches` takes it apart, `fit` finds the curve, the loss and the
softening, with `curve` for the points of the curve; `write` makes a file of a material from them.
"""
