"""The terms of the energy, one file each: energy, gradient, Hessian, in the symbols of the paper.

`stretch` and `bend` evaluate the material laws of `kernels.laws` at the sections of the walls.
"""
