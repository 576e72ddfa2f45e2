"""Kernels of the stock compiler: `numba.njit`, and what Numba documents for extensions.

Code for Python takes hundreds of arrays out of named tuples, which is more to compile than most
kernels are. So a kernel is two functions of Numba: one that kernels call, without such code, and
one for Python, made at its first call. Only the latter is kept: it contains all that it calls.
"""

import functools

import numba
from numba.extending import typeof_impl

from kernels.compile.reference import Referenced, referred
from kernels.compile.undisturbed import undisturbed

PACKAGE = __name__.rsplit(".", 2)[0] + "."


def is_of_kernels(value):
    """Whether the sources that name the folder hold what an argument stands for: the verbs of a
    named tuple from elsewhere may change, and the change would go unnoticed.
    """
    if isinstance(value, Referenced):
        value = referred(value)
    if not isinstance(value, tuple):
        return True
    home = type(value).__module__
    return home.startswith(("builtins", PACKAGE)) and all(map(is_of_kernels, value))


class Kernel:
    """A function for other kernels to call, and for Python: that is its `entry`."""

    def __init__(self, function, fastmath, owning):
        self._options = {
            "nogil": True,
            "error_model": "numpy",
            "fastmath": fastmath,
            "no_cfunc_wrapper": True,
        }
        self.linked = numba.njit(no_cpython_wrapper=True, **self._options)(function)
        functools.update_wrapper(self, function)

    @functools.cached_property
    def entry(self):
        """The dispatcher for calls from Python, whose machine code is kept."""
        return numba.njit(cache=True, **self._options)(self.__wrapped__)

    @functools.cached_property
    def passing(self):
        """The dispatcher for calls from Python whose machine code must not be kept."""
        return numba.njit(**self._options)(self.__wrapped__)

    def __call__(self, *args):
        """Call it from Python."""
        return (self.entry if all(map(is_of_kernels, args)) else self.passing)(*args)

    def __get__(self, problem, kind=None):
        """Return it as a verb of a named tuple (`verbs`)."""
        return self if problem is None else functools.partial(self, problem)


@typeof_impl.register(Kernel)
def _typeof(kernel, context):
    return typeof_impl(kernel.linked, context)


def compile_ahead(run):
    """Run it once, undisturbed: what it needs is compiled at its calls."""
    undisturbed(run)()
