"""Fits a material to a user's own test of a printed strip or puck.

`table` finds the numbers in the file of a testing machine, `columns` assigns them to quantities
with their units (`unit`), `record` makes a test of them, `legs` divides it into loading, unloading
and reloading. `fit` finds the loss and the softening of the material, `curve` its stresses over
strain, `uncertainty` their standard errors, `hyperelastic` the tension of a puck; `write` writes a
material file. `answers` has the options of the user, `measured` the measured quantities and sizes,
`check` and `direction` detect mistakes, `zero` finds the origin. `materials` does the same from
Python.
"""
