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

import numba
from numba import _dynfunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import NativeLowering

from kernels.cache import SealedCache


class Linked(JITCodeLibrary):
    """Code that is linked into its callers, where it is optimised and made machine code.

    Doing so at every level would double the time of a compilation.
    """

    def _optimize_functions(self, ll_module):
        ll_module.data_layout = self._codegen._data_layout

    def _optimize_final_module(self):
        """Leave it as it is."""

    def _finalize_final_module(self):
        self._finalize_dynamic_globals()
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class LinkedLowering(NativeLowering):
    """Numba's lowering to a library that callers link, with no address of its own."""

    _name = "linked_lowering"

    def run_pass(self, state):
        """Lower the function and make it known to its callers."""
        state.library = Linked(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        super().run_pass(state)
        lowered, context = state["cr"], state.targetctx
        name = lowered.fndesc.qualname
        nowhere = 1  # an address that is not called
        key = _dynfunc.make_function(
            lowered.fndesc.lookup_module(), name, name, nowhere, lowered.env, (state.library,)
        )
        context.insert_user_function(key, lowered.fndesc, [state.library])
        state["cr"] = lowered._replace(cfunc=key)
        return True


class LinkedCompiler(Compiler):
    """Numba's compiler with `LinkedLowering`."""

    def define_pipelines(self):
        """Return Numba's passes with the lowering exchanged."""
        passes = super().define_pipelines()
        for manager in passes:
            manager.passes = [
                (LinkedLowering if step is NativeLowering else step, what)
                for step, what in manager.passes
            ]
            manager._finalized = False
            manager.finalize()
        return passes


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
        dispatcher = _dispatcher(self.__wrapped__, self.options)
        dispatcher._cache = SealedCache(self.__wrapped__)
        return dispatcher

    def __call__(self, *args):
        """Call it from Python."""
        return self.entry(*args)

    def __getattr__(self, name):
        return getattr(self._linked, name)


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


def compiler(fastmath, owning=False, inline="never"):
    """Decorator that compiles a function for the argument types it meets, and keeps the code.

    Without ``owning`` the code counts no references, which costs four times the arithmetic of an
    assembly; such a function may read and fill arrays but must not make or return any. ``inline``
    writes it out in its caller, for the few that would otherwise be optimised at every level.
    """
    options = {"fastmath": fastmath, "_nrt": owning, "inline": inline}

    def decorate(function):
        if numba.config.DISABLE_JIT:
            return function
        return Kernel(function, options)

    return decorate


jit = compiler({"contract", "reassoc", "nsz", "arcp"})
jit_exact = compiler(False)
jit_owning = compiler(False, owning=True)
jit_inlined = compiler(False, owning=True, inline="always")
