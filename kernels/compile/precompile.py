"""Compiles all that a run needs beforehand, as the compiler in use can."""

from kernels.compile.choice import FAST, compiler

if compiler() == FAST:
    from kernels.compile.fast.precompile import compile_ahead
else:
    from kernels.compile.stock import compile_ahead

__all__ = ["compile_ahead"]
