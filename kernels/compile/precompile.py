"""`compile_ahead` of the compiler in use: it compiles the kernels of a run beforehand."""

from kernels.compile.choice import FAST, compiler

if compiler() == FAST:
    from kernels.compile.fast.precompile import compile_ahead
else:
    from kernels.compile.stock import compile_ahead

__all__ = ["compile_ahead"]
