"""The linear system of a Newton step: walls condensed one by one, then an LDL^T of 3 x 3 blocks."""
