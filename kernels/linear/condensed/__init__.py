"""The factor of a planar lattice: inner nodes of walls are condensed, then joints are solved.

`analysis` plans it once, `bundles` lays like walls side by side, `condense` eliminates their inner
nodes, `block_matrix` and `block_ldlt` hold and factor the joints; `system` is what a problem calls.
"""
