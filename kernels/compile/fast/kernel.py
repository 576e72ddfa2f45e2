"""What a decorated function becomes: a `Kernel`, which other kernels and Python can call.

For a kernel that calls it, it is code to be linked (`linking`), or the address of its own machine
code if it is `jit.separate` (`outlined`). For Python it is machine code that includes all that it
calls, which is made at the first such call and is kept (`sealed`).
"""

import functools
import inspect
from contextvars import ContextVar

import numba
from numba.core.compiler_lock import global_compiler_lock
from numba.core.sigutils import normalize_signature

from kernels.compile.fast.linking import EntryCompiler, LinkedCompiler
from kernels.compile.fast.outlined import link
from kernels.compile.fast.sealed import SealedCache
from kernels.compile.undisturbed import undisturbed

rehearsal = ContextVar("rehearsal", default=None)
"""What is called in place of a kernel, with the kernel and its arguments (`precompile`)."""


class Kernel:
    """A function for other kernels to call, and for Python: that is its `entry`.

    One that is not ``owning`` counts no references, which costs four times the arithmetic of an
    assembly: it may read and fill arrays but must not make any, nor return one but to another that
    does not count.
    """

    def __init__(self, function, fastmath, owning):
        options = {"fastmath": fastmath, "_nrt": owning}
        linked = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        self.linked = _dispatcher(function, options | linked, pipeline_class=LinkedCompiler)
        self.linked.compile = self._compile_linked
        self._numba_type_ = numba.types.Dispatcher(self.linked)
        self.options = options
        self.is_separate = False
        functools.update_wrapper(self, function)

    def _compile_linked(self, signature):
        """Compile it for a kernel that calls it, without the clocks that numba starts for it."""
        args, _ = normalize_signature(signature)
        if args not in self.linked.overloads:
            if self.is_separate:
                link(self, args)
            else:
                self.linked.add_overload(self.linked._compiler.compile(args, None))
        return self.linked.overloads[args].entry_point

    @functools.cached_property
    def entry(self):
        """The dispatcher for calls from Python, whose machine code is kept.

        That of a separate kernel only calls the machine code which is there already.
        """
        return self._dispatcher(_calling(self) if self.is_separate else self.__wrapped__)

    @functools.cached_property
    def separated(self):
        """The dispatcher of the code that other kernels call where it is, which is kept too."""
        return self._dispatcher(self.__wrapped__, "separated", no_cpython_wrapper=True)

    def _dispatcher(self, function, kind="", **more):
        options = self.options | {"no_cfunc_wrapper": True} | more
        dispatcher = _dispatcher(function, options, pipeline_class=EntryCompiler)
        dispatcher._cache = SealedCache(self.__wrapped__, kind)
        dispatcher.compile = global_compiler_lock(undisturbed(dispatcher.compile))
        return dispatcher

    def compiled(self, args):
        """Return numba's result for arguments of these types, from what is kept if it is there."""
        dispatcher = self.separated if self.is_separate else self.entry
        dispatcher.compile(args)
        return dispatcher.overloads[args]

    def __call__(self, *args):
        """Call it from Python."""
        rehearsed = rehearsal.get()
        return self.entry(*args) if rehearsed is None else rehearsed(self, args)

    def __get__(self, problem, kind=None):
        """Return it as a verb of a named tuple (`verbs`)."""
        return self if problem is None else functools.partial(self, problem)

    def __getattr__(self, name):
        if name == "linked":  # unpickled, or not made yet
            raise AttributeError(name)
        return getattr(self.linked, name)


def _calling(kernel):
    """Return a function of the same arguments that calls a kernel and does nothing else."""
    names, made = ", ".join(inspect.signature(kernel.__wrapped__).parameters), {}
    exec(f"def call({names}): return kernel({names})", {"kernel": kernel}, made)
    return made["call"]


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
