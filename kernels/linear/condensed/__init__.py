"""The factor of a planar lattice (`kernels.planar`): inner nodes of walls, then the joints.

`analysis` plans it once, `bundles` groups equal walls, `condense` eliminates their inner nodes,
`block_matrix` and `block_ldlt` hold and factor the joints. In an endless lattice `periodic_images`
passes forces and moves between images and the coordinates that they follow. `system` is the
interface to the problem.
"""
