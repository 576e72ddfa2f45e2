"""The method: the minimum of one step, the march through a loading, arcs along a path.

`problem` states what the method asks of a problem; no module here imports a term of the energy.
`newton` finds the minimum, `integrators` and `march` advance in time, `arc_length` follows a path,
and `energy_book` enters where the work of each step went.
"""
