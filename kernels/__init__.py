"""Compiled kernels: arrays and floats in SI in, arrays and floats out; nothing here knows `sweep`.

`terms` has the equations, `solve` the method, `linear` the factor, `geometry` what may meet;
`compile` is how all of it becomes machine code.
"""
