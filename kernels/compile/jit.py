"""The decorators of kernels, one for each kind of arithmetic.

``@jit`` is for ordinary arithmetic; ``@jit_exact`` keeps every rounding as written, for collision
detection, distances, tests of a sign or a pivot, and sums of the energy book (fast-math destroys
exact zeros and compensated sums); ``@jit_owning`` is exact too and may allocate arrays. All release
the GIL, so that threads run side by side.

A kernel that Python calls becomes machine code at the first such call, together with all that it
calls, and is cached (`cache`).
"""

import numba

from kernels.compile import cache, verbs  # noqa: F401  (cache: Numba keeps code in that folder)
from kernels.compile.kernel import Kernel

verbs.register(lambda value: isinstance(value, Kernel))


def decorator(fastmath, owning=False):
    """Return a decorator that compiles a function for the argument types it meets, and caches the
    code.

    Only functions that are ``owning`` may allocate arrays.
    """

    def decorate(function):
        if numba.config.DISABLE_JIT:
            return function
        return Kernel(function, fastmath, owning)

    return decorate


jit = decorator({"contract", "reassoc", "nsz", "arcp"})
jit_exact = decorator(False)
jit_owning = decorator(False, owning=True)
