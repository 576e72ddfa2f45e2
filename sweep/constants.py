"""Factors of units in files, standard gravity, and the filter of forces."""

MM = 1e-3  # m
TO_MM, TO_MM3 = 1e3, 1e9  # from m, m^3
STANDARD_GRAVITY = 9.80665  # m/s^2
SAMPLES = 10  # least rows per second / class of a filter of forces
FILTER_CLASS = 1000  # of the filter of a crush with a speed, Hz
