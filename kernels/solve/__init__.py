"""The solution method: the minimum of one step, the march through a loading, arcs along a path.

`problem` states what the method requires of a problem; no module here imports a term of the energy.
`newton` finds the minimum, to the tolerances in `residual`; `resolution` decides whether it may be
a step. `integrators` and `march` advance in time, in steps chosen by `step_size` and
`load_step_error`, `arc_length` follows a path, and `energy_book` records where the work of each
step went. `outcomes` lists how a minimisation, a share of a step or an arc ends. `history` has the
state between steps, `workspace` the scratch arrays.
"""
