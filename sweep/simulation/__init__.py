"""From a case to its result: the run, and the measures derived from it."""
