"""How kernels are compiled: the only numba options.

``@jit`` is for arithmetic; ``@jit_exact`` keeps every rounding as written, for collision detection,
distances, tests of a sign or a pivot, and sums of the energy book (fast-math destroys exact zeros
and compensated sums); ``@jit_owning`` is exact too and may make arrays. All release the GIL, so
that threads run side by side.

A kernel that other kernels call is only linked into them, and is machine code only there. What is
called from Python becomes machine code at the first such call, together with all that it calls, and
is kept (`cache`).
"""

import functools
import gc

import numba
from numba.core.compiler_lock import global_compiler_lock

from kernels.cache import SealedCache
from kernels.linking import EntryCompiler, LinkedCompiler


class Kernel:
    """A function for other kernels to call, and for Python: that is its `entry`."""

    def __init__(self, function, options):
        linked = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        self._linked = _dispatcher(function, options | linked, pipeline_class=LinkedCompiler)
        self._numba_type_ = numba.types.Dispatcher(self._linked)
        self.options = options
        functools.update_wrapper(self, function)

    @functools.cached_property
    def entry(self):
        """The dispatcher for calls from Python, whose machine code is kept."""
        dispatcher = _dispatcher(self.__wrapped__, self.options, pipeline_class=EntryCompiler)
        dispatcher._cache = SealedCache(self.__wrapped__)
        dispatcher.compile = _uncollected(dispatcher.compile)
        return dispatcher

    def __call__(self, *args):
        """Call it from Python."""
        return self.entry(*args)

    def __getattr__(self, name):
        return getattr(self._linked, name)


def _uncollected(compile_):
    """Compile without the garbage collector: it takes a sixth of the time and finds little."""

    @global_compiler_lock
    @functools.wraps(compile_)
    def compiled(signature):
        collects = gc.isenabled()
        gc.disable()
        try:
            return compile_(signature)
        finally:
            if collects:
                gc.enable()

    return compiled


def _dispatcher(function, options, **how):
    """Numba's dispatcher.

    A constant argument gets no version of its own, which Numba would compile for every one.
    """
    dispatcher = numba.njit(nogil=True, error_model="numpy", **how, **options)(function)
    typed = dispatcher.get_call_template
    dispatcher.get_call_template = lambda args, kws: typed(
        [numba.types.unliteral(a) for a in args], kws
    )
    return dispatcher


def compiler(fastmath, owning=False):
    """Decorator that compiles a function for the argument types it meets, and keeps the code.

    Without ``owning`` the code counts no references, which costs four times the arithmetic of an
    assembly; such a function may read and fill arrays but must not make any, nor return one but to
    another that does not count.
    """
    options = {"fastmath": fastmath, "_nrt": owning}

    def decorate(function):
        if numba.config.DISABLE_JIT:
            return function
        return Kernel(function, options)

    return decorate


jit = compiler({"contract", "reassoc", "nsz", "arcp"})
jit_exact = compiler(False)
jit_owning = compiler(False, owning=True)
