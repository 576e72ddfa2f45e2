"""Who wins: rankings, Pareto fronts, ties, and error against run time, from results alone."""
