"""Profiles of slicers: the file, its settings, and what they mean for a lattice."""
