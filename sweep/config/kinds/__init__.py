"""The kinds of the tables of a case: each has only its own keys, and completes itself.

`lattice` is one of `cells`, `sliced`, `drawn` and `custom_structure`, which share `specimen`, and
of `sheet` and `sliced_sheet`; `loading` is one of `dead_load`, `crush`, `impact` and
`custom_loading`. `contact`, `damping` and `solver` have their kinds in one file each; `material`
has one kind. A function named after a kind makes it from the given values of a config, or raises
`RefusedError`. `table` has the code that they share, `directed`, `direction` and `striker` the
common keys of loadings, `body` the body that is pressed, `upright`, `mesh` and `printable` rules
for lattices, and `steps` chooses the solver.
"""
