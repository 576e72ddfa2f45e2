"""How kernels become machine code and where that is kept; the only home of numba and llvmlite.

Kernels import `jit` and, for large named tuples and their methods, `reference` and `verbs`.
"""
