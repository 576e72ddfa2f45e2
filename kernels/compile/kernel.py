"""`Kernel`, the result of decorating a function, which other kernels and Python can call.

To call a kernel from Python, code must unpack hundreds of arrays from named tuples, and this code
takes longer to compile than most kernels do. A kernel is therefore two functions of Numba: one for
other kernels, without such code, and one for Python, made at its first call. Only the latter is
cached: it contains everything that it calls.
"""

import functools

import numba
from numba.core.options import DefaultOptions
from numba.extending import typeof_impl

from kernels.compile.choice import FAST, compiler
from kernels.compile.reference import Referenced, referred
from kernels.compile.undisturbed import undisturbed

PACKAGE = __name__.rsplit(".", 2)[0] + "."

if compiler() == FAST:
    from kernels.compile.linking import Compiler
    from kernels.compile.sealed import SealedCache

    HOW = {"pipeline_class": Compiler}
else:
    HOW, SealedCache = {}, None


def is_of_kernels(value):
    """Return whether the hash of the kernel sources covers an argument.

    The verbs of a named tuple from elsewhere may change, and the change would go unnoticed.
    """
    if isinstance(value, Referenced):
        value = referred(value)
    if not isinstance(value, tuple):
        return True
    home = type(value).__module__
    return home.startswith(("builtins", PACKAGE)) and all(map(is_of_kernels, value))


class Kernel:
    """A function that other kernels call; Python calls its `entry`.

    A kernel that is not ``owning`` counts no references, as counting costs four times the
    arithmetic of an assembly: it may read and fill arrays but must not allocate any.
    """

    def __init__(self, function, fastmath, owning):
        self._options = {
            "nogil": True,
            "error_model": "numpy",
            "fastmath": fastmath,
            "no_cfunc_wrapper": True,
        } | HOW  # fmt: skip
        if hasattr(DefaultOptions, "_nrt"):  # by default it is the option of the first caller
            self._options["_nrt"] = owning
        self.linked = self._dispatcher(function, no_cpython_wrapper=True)
        functools.update_wrapper(self, function)

    def _dispatcher(self, function, **more):
        """Return Numba's dispatcher.

        Constant arguments get no version of their own; Numba would compile one for every constant.
        """
        dispatcher = numba.njit(**self._options, **more)(function)
        typed = dispatcher.get_call_template
        dispatcher.get_call_template = lambda args, kws: typed(
            [numba.types.unliteral(kind) for kind in args], kws
        )
        return dispatcher

    @functools.cached_property
    def entry(self):
        """The dispatcher for calls from Python, whose machine code is cached."""
        entry = self._dispatcher(self.__wrapped__, cache=True)
        if SealedCache is not None:
            entry._cache = SealedCache(self.__wrapped__)
        entry.compile = undisturbed(entry.compile)
        return entry

    @functools.cached_property
    def passing(self):
        """The dispatcher for calls from Python whose machine code must not be cached."""
        passing = self._dispatcher(self.__wrapped__)
        passing.compile = undisturbed(passing.compile)
        return passing

    def __call__(self, *args):
        """Call the kernel from Python."""
        return (self.entry if all(map(is_of_kernels, args)) else self.passing)(*args)

    def __get__(self, problem, kind=None):
        """Return the kernel as a verb of a named tuple (`verbs`)."""
        return self if problem is None else functools.partial(self, problem)


@typeof_impl.register(Kernel)
def _typeof(kernel, context):
    return typeof_impl(kernel.linked, context)
