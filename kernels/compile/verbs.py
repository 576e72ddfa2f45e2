"""Methods of named tuples: kernels that other kernels find by the type of a tuple.

``problem.evaluate(x)`` calls the kernel `evaluate` of the class of ``problem``: code that calls
verbs is compiled for each class of problem that it meets, and for no other.
"""

from numba import typeof, types
from numba.core.typing import signature
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate
from numba.extending import infer_getattr, lower_builtin

from kernels.compile.reference import Reference

VERB = "verb"  # and its name: the key by which Numba finds how a verb is called
_declared = set()


class _Verb(AbstractTemplate):
    """A call of a verb of a named tuple, ``this``, that Numba already knows."""

    def generic(self, args, kws):
        kernel = getattr(self.this.instance_class, self.name)
        call_type = typeof(kernel).get_call_type(self.context, (self.this, *args), kws)
        return signature(call_type.return_type, *call_type.args[1:], recvr=self.this)


def _declare(name):
    """Tell Numba how to call the verb of this name: as a kernel."""
    if name in _declared:
        return
    _declared.add(name)

    @lower_builtin((VERB, name), types.BaseNamedTuple, types.VarArg(types.Any))
    @lower_builtin((VERB, name), Reference, types.VarArg(types.Any))
    def code(context, builder, sig, args):
        kernel = typeof(getattr(sig.args[0].instance_class, name))
        call_type = kernel.get_call_type(context.typing_context, sig.args, {})
        call = context.get_function(kernel, call_type)
        context.add_linking_libs(getattr(call, "libs", ()))
        return call(builder, args)


def register(is_kernel):
    """Let kernels call verbs: the attributes ``is_kernel`` of the class of a named tuple."""

    class Verbs(AttributeTemplate):
        def generic_resolve(self, kind, name):
            if not is_kernel(getattr(kind.instance_class, name, None)):
                return None  # a field
            _declare(name)
            template = type(name, (_Verb,), {"key": (VERB, name), "name": name})
            return types.BoundFunction(template, kind)

    for kind in (types.BaseNamedTuple, Reference):
        infer_getattr(type(Verbs.__name__, (Verbs,), {"key": kind}))
