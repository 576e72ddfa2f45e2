"""How kernels become machine code, and where that is kept: the only home of numba and llvmlite."""
