"""The drawing of a lattice: families of infill, network of walls, printed area, sizing."""
