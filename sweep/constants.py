"""Factors of units in files, and standard gravity."""

MM = 1e-3  # m
TO_MM, TO_MM3 = 1e3, 1e9  # from m, m^3
STANDARD_GRAVITY = 9.80665  # m/s^2
