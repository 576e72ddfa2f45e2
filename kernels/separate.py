"""Kernels with machine code of their own, which other kernels call where it is.

What is linked into its callers is compiled with each of them. A large kernel is better compiled
once: beside the others, in another process (`ahead`), and for several callers. The price is a call
that passes every array of its named tuples, a third of a microsecond for a thousand arguments.
"""

import hashlib
from contextvars import ContextVar
from dataclasses import dataclass
from importlib import import_module

from llvmlite.binding import add_symbol
from numba.core import types
from numba.core.compiler import CompileResult
from numba.core.funcdesc import FunctionDescriptor
from numba.core.typing import Signature

from kernels import calling
from kernels.linking import Linked

NOWHERE = 1  # an address that is not called
elsewhere = ContextVar("elsewhere", default={})  # noqa: B039  (never changed)
"""Return types of what another process compiles, by module, name and types of the arguments: code
that calls it is compiled to be kept, not to be run.
"""


@dataclass(frozen=True)
class Address:
    """Where the code of a kernel is, for arguments of these types.

    What is kept of a caller's code has it with it, and calls it when it is loaded.
    """

    module: str
    name: str
    args: tuple[types.Type, ...]
    returns: types.Type

    @property
    def symbol(self):
        """The name by which callers know it."""
        digest = hashlib.blake2b(repr(self.args).encode(), digest_size=8).hexdigest()
        return f"{self.module}.{self.name}.{digest}"

    def compiled(self):
        """Return numba's result for it, from what is kept if it is there."""
        return getattr(import_module(self.module), self.name).compiled(self.args)

    def __call__(self):
        """Tell the address of the code."""
        compiled = self.compiled()
        if compiled.signature.return_type != self.returns:
            raise TypeError(f"{self.symbol} returns {compiled.signature.return_type}")
        name = compiled.fndesc.llvm_func_name
        add_symbol(self.symbol, compiled.library.get_pointer_to_function(name))

    def insert(self, dispatcher):
        """Tell the compiler of it, by the ``dispatcher`` that callers meet."""
        context, code = dispatcher.targetctx, dispatcher.py_func.__code__
        description = FunctionDescriptor(
            True, self.module, self.name, self.symbol, "", {}, self.returns, {},
            code.co_varnames[: code.co_argcount], (),
            mangler=lambda *_, **__: self.symbol, argtypes=self.args,
        )  # fmt: skip
        library = Linked(context.codegen(), self.symbol)
        library._reload_init.add(self)
        library.finalize()
        calling.insert(context, self, description, [library], not dispatcher.targetoptions["_nrt"])
        known = dict.fromkeys(CompileResult._fields)
        known |= {"signature": Signature(self.returns, self.args, None), "entry_point": self}
        dispatcher.overloads[self.args] = CompileResult(**known)


def insert(kernel, args):
    """Let another kernel call ``kernel`` with arguments of these types."""
    known = kernel.__module__, kernel.__name__, args
    returns = elsewhere.get().get(known)
    if returns is None:
        address = Address(*known, kernel.compiled(args).signature.return_type)
        address()
    else:
        address = Address(*known, returns)
        add_symbol(address.symbol, NOWHERE)
    address.insert(kernel.linked)
