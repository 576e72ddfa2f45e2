"""The effective material of an endless infill: elastic constants, buckling stress, density.

`cell` finds the smallest period as a frame, `stiffness` its elastic constants, `buckling` the
stress at which it buckles, and `material` collects them.
"""
