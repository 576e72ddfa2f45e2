"""How kernels become machine code and where that is kept; the only home of numba and llvmlite.

Kernels import `jit`, `reference` for large named tuples, and `simd`; `verbs` finds the methods of
named tuples. `kernel` is what a decorated function becomes, `linking` optimises it together with
all that it calls, if `choice` knows the installed Numba; `undisturbed` saves time. `cache` names
the folder in which machine code is kept, `sealed` checks what is read from it.
"""
