"""Shells against the theory of plates: buckling, pressure, rolled strips, joints of walls."""
