"""Which design is best: rankings, Pareto fronts, ties, and error against run time.

Only results are read: neither the kernels nor the configs are needed here.
"""
