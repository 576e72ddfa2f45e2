"""Reads profiles of slicers: the file, its settings, and their meaning for a lattice."""
