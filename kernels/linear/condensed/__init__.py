"""The factor of a planar lattice (`kernels.planar`): inner nodes of walls, then the joints.

`analysis` plans it once, `bundles` lays like walls side by side, `condense` eliminates their inner
nodes, `block_matrix` and `block_ldlt` hold and factor the joints. In an endless lattice
`periodic_images` passes forces and moves between images and the coordinates that they follow.
`system` is what the problem calls.
"""
