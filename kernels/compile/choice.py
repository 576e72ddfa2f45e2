"""Chooses the compiler: the environment variable CRUMPLE_COMPILER, or else the installed Numba,
decides.

"fast" uses private parts of the Numba versions that are listed here; "stock" is `numba.njit`. Both
give the same results.
"""

import functools
import os
import sys
from importlib.metadata import PackageNotFoundError, version

VARIABLE = "CRUMPLE_COMPILER"
FAST, STOCK, NONE = "fast", "stock", "none"
KNOWN = (("0.68", "0.50"),)  # Numba and llvmlite whose private parts are known


class CompilerError(ValueError):
    """CRUMPLE_COMPILER names a compiler that does not exist."""


def _installed(package):
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


def choose(choice, numba, llvmlite):
    """Return the compiler for a ``choice`` ("" for none) and these versions, and a note for the
    user or None.
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
    """Return the compiler of this process, "none" if NUMBA_DISABLE_JIT leaves kernels as plain
    Python. Report an unusual compiler once on stderr.

    Child processes find the choice in their environment, and print nothing.
    """
    if os.environ.get("NUMBA_DISABLE_JIT", "0") != "0":
        return NONE
    choice = os.environ.get(VARIABLE, "")
    chosen, notice = choose(choice, _installed("numba"), _installed("llvmlite"))
    if notice:
        sys.stderr.write(f"{notice}\n")
        os.environ[VARIABLE] = chosen
    return chosen
