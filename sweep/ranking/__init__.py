"""Ranks designs: places, Pareto fronts, ties, and error against run time.

`rank` answers a `question` with a `ranking` of the rows of a results file: `scenes` says which
cases are compared, `merit` by which columns, `places` which of them are equal, `budget` and
`requirements` which limits a design must meet; `unfinished` deals with cases that stopped.
`assessment` has the values that a search compares, `spread` says how far the values of a ranking
move with uncertain numbers. `accuracy` and `richardson` estimate errors, `cushion` and `curves`
read whole curves, and `comparison` compares predictions with measured values.

Only results are read: the kernels are not needed, and of the configs only the units, for questions
with quantities as text (`question.in_si`).
"""
