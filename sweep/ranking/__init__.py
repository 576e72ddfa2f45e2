"""Rankings, Pareto fronts, ties, and error against run time, computed from results alone."""
