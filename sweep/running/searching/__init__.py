"""The search for the best design: the space of designs, the search in it, its finalists."""
