"""Compiled kernels: arrays and floats in SI in, arrays and floats out, with no import of `sweep`.

Read `laws` and `terms` for the equations, `planar` for their sum, and `solve` for the method that
finds its minimum. `linear` factors the Hessian, `geometry` finds what may touch, and `compile`
turns all of it into machine code. The equations in print: kernels/README.md.
"""
