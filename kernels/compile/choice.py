"""Chooses the compiler: by the environment variable CRUMPLE_COMPILER, else by the Numba installed.

"fast" is made of private parts of the Numba that it knows; "stock" is `numba.njit`. Both give the
same results.
"""

import functools
import os
import sys
from importlib.metadata import PackageNotFoundError, version

VARIABLE = "CRUMPLE_COMPILER"
FAST, STOCK, NONE = "fast", "stock", "none"
KNOWN = (("0.68", "0.50"),)  # Numba and llvmlite whose private parts are known


class CompilerError(ValueError):
    """A compiler that does not exist was asked for."""


def _installed(package):
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


def choose(choice, numba, llvmlite):
    """Return the compiler for a ``choice`` ("" for none) and for these versions, and what
    the user should know of that, if anything.
    """
    if choice in (FAST, STOCK):
        return choice, None
    if choice:
        raise CompilerError(f"{VARIABLE} = {choice!r}; allowed: {FAST}, {STOCK}")
    series = tuple(".".join(text.split(".")[:2]) for text in (numba, llvmlite))
    if series in KNOWN:
        return FAST, None
    supported = " or ".join(f"{one}.x with llvmlite {other}.x" for one, other in KNOWN)
    return STOCK, (
        f"crumple: the stock compiler is used, as Numba {numba} with llvmlite {llvmlite} is not "
        f"{supported}: results are the same, the first start takes longer ({VARIABLE}={STOCK} "
        "says so without this line)"
    )


@functools.cache
def compiler():
    """Return the compiler of this process, "none" where Numba leaves all as plain Python. Say on
    stderr, once, if it is not the usual one.

    Processes that this one starts find the choice in their environment, and print nothing.
    """
    if os.environ.get("NUMBA_DISABLE_JIT", "0") != "0":
        return NONE
    choice = os.environ.get(VARIABLE, "")
    chosen, notice = choose(choice, _installed("numba"), _installed("llvmlite"))
    if notice:
        sys.stderr.write(f"{notice}\n")
        os.environ[VARIABLE] = chosen
    return chosen
