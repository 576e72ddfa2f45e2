"""Which design is best: rankings, Pareto fronts, ties, and error against run time.

`rank` answers a `question` with a `ranking` of the rows of a results file: `scenes` says which
cases are compared, `merit` by which columns, `places` which of them are equal, `requirements` what
a design must meet. `assessment` has the values that a search compares, `spread` how far uncertain
numbers move it. `accuracy` and `richardson` estimate errors, `cushion` and `curves` read whole
curves.

Only results are read: neither the kernels nor the configs are needed here.
"""
