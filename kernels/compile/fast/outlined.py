"""Separate kernels (`jit.separate`): compiled once, and called by other kernels instead of linked.

A kernel that is linked into its callers is compiled with each of them. A large kernel is better
compiled once for all callers, in another process (`precompile`). The price is a call that passes
every array of its named tuples, which suits kernels that are called a few times a step, at most.
"""

import hashlib
from contextvars import ContextVar
from dataclasses import dataclass
from importlib import import_module
from types import MappingProxyType

from llvmlite.binding import add_symbol
from numba.core import types
from numba.core.compiler import CompileResult
from numba.core.funcdesc import FunctionDescriptor
from numba.core.typing import Signature

from kernels.compile.fast import abi
from kernels.compile.fast.linking import NOWHERE, Linked

foreseen = ContextVar("foreseen", default=MappingProxyType({}))
"""Return types of what another process compiles, by module, name and types of the arguments: code
that calls it is compiled to be kept, not to be run.
"""


def _spelled(kind):
    """Return a name of a type that no other has: Numba's name lacks the module of a tuple."""
    if not isinstance(kind, types.BaseTuple):
        return repr(kind)
    made = getattr(kind, "instance_class", tuple)
    names = f"{made.__module__}.{made.__qualname__}{getattr(made, '_fields', ())}"
    return f"{names}({', '.join(map(_spelled, kind))})"


@dataclass(frozen=True)
class Version:
    """A kernel for arguments of these types.

    What is kept of the code that calls it has it with it: numba calls it before it loads that.
    """

    module: str
    name: str
    args: tuple[types.Type, ...]
    returns: types.Type

    @property
    def symbol(self):
        """The name by which callers know its code, the same in all processes."""
        spelled = " ".join(map(_spelled, self.args)).encode()
        return f"{self.module}.{self.name}.{hashlib.blake2b(spelled, digest_size=8).hexdigest()}"

    def compiled(self):
        """Return numba's result for it, from what is kept if it is there."""
        return getattr(import_module(self.module), self.name).compiled(self.args)

    def __call__(self):
        """Let code that calls it find it, or refuse: then that is compiled again."""
        compiled = self.compiled()
        if compiled.signature.return_type != self.returns:
            raise TypeError(f"{self.symbol} returns {compiled.signature.return_type}")
        name = compiled.fndesc.llvm_func_name
        add_symbol(self.symbol, compiled.library.get_pointer_to_function(name))

    def declare(self, dispatcher):
        """Tell numba of it, by the ``dispatcher`` that callers meet."""
        context, code = dispatcher.targetctx, dispatcher.py_func.__code__
        description = FunctionDescriptor(
            True, self.module, self.name, self.symbol, "", {}, self.returns, {},
            code.co_varnames[: code.co_argcount], (),
            mangler=lambda *_, **__: self.symbol, argtypes=self.args,
        )  # fmt: skip
        library = Linked(context.codegen(), self.symbol)
        library._reload_init.add(self)
        library.finalize()
        short = not dispatcher.targetoptions["_nrt"]  # as `abi.is_short` has it
        abi.register(context, self, description, [library], short)
        known = dict.fromkeys(CompileResult._fields)
        known |= {"signature": Signature(self.returns, self.args, None), "entry_point": self}
        dispatcher.overloads[self.args] = CompileResult(**known)


def link(kernel, args):
    """Let another kernel call the code of ``kernel`` for arguments of these types."""
    known = kernel.__module__, kernel.__name__, args
    returns = foreseen.get().get(known)
    if returns is None:
        version = Version(*known, kernel.compiled(args).signature.return_type)
        version()
    else:
        version = Version(*known, returns)
        add_symbol(version.symbol, NOWHERE)
    version.declare(kernel.linked)
