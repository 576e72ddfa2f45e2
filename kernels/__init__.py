"""Compiled kernels: arrays and floats in SI in, arrays and floats out, with no import of `sweep`.

Read `laws` and `terms` for the equations, `planar` and `plates` for their sums, and `solve` for the
method that finds the minimum. `linear` factors the Hessian, `geometry` finds pairs that may touch,
`shared` has what both problems need, and `compile` turns everything into machine code. The
equations in print: kernels/README.md.
"""
