"""Reads profiles of slicers: `settings` reads the file, `profile` translates it into keys of a
lattice.
"""
