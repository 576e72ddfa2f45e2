"""The method: the minimum of one step, the march through a loading, arcs along a path.

`problem` states what the method asks of a problem; no module here imports a term of the energy.
`newton` finds the minimum, `friction_loop` repeats it for lagged forces, `integrators` and `march`
advance in time, and `energy_book` enters where the work of each step went.
"""
