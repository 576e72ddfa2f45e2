"""How kernels become machine code and where that is kept; the only home of numba and llvmlite.

Kernels import `jit`, `reference` for large named tuples, and `simd`; `verbs` finds the methods of
named tuples.
"""
