"""Runs that accompany a sweep, in results files of their own.

`error_bars` simulates every design again with a coarser mesh and with longer steps, `spread` the
best ones with other numbers of their materials, and `screen` simulates one cell of each design
first. All three use `run_beside`; `refinement` makes a case finer or coarser.
"""
