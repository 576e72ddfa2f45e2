"""Studies of rankings: error bars, orders of designs, the search, spreads, renumbered nodes."""
