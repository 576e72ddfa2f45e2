"""Which design is best: rankings, Pareto fronts, ties, and error against run time.

`rank` sorts the table of a results file into a `ranking`, `merit` has the columns that are
compared, `requirements` what a design must meet, `worth` the value of a design in a search.
`accuracy` and `richardson` tell the error, `cushion` and `curves` read whole curves.

Only results are read: neither the kernels nor the configs are needed here.
"""
