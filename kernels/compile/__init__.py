"""How kernels become machine code and where that is kept; the only home of numba and llvmlite.

Kernels import `jit`, `reference` for large named tuples, and `simd`; `verbs` finds the methods of
named tuples. `choice` says which compiler is used: `fast`, made of private parts of Numba, or
`stock`. With either, `precompile` compiles ahead, `undisturbed` saves time, and `cache` names the
folder in which machine code is kept.
"""
