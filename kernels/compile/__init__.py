"""Compilation of kernels to machine code, and its cache; the only home of numba and llvmlite.

Kernels import the decorators of `jit`, `reference` for large named tuples, and `simd`; `verbs`
finds the methods of named tuples. A decorated function becomes a `kernel`. If `choice` knows the
installed Numba, `linking` optimises a kernel together with everything that it calls; `undisturbed`
makes compilation faster. `cache` names the folder of the machine code, `sealed` checks the files
that are read from it.
"""
