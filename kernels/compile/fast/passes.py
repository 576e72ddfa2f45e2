"""The passes of Numba's compiler that kernels need, with searches for signatures remembered."""

import functools

from numba.core import typed_passes, untyped_passes
from numba.core.compiler import CompilerBase, Flags
from numba.core.compiler_machinery import PassManager
from numba.core.targetconfig import ConfigStack
from numba.core.types.functions import BaseFunction

PASSES = (
    untyped_passes.TranslateByteCode,
    untyped_passes.FixupArgs,
    untyped_passes.IRProcessing,
    untyped_passes.GenericRewrites,
    untyped_passes.ReconstructSSA,
    typed_passes.NopythonTypeInference,
    typed_passes.PreLowerStripPhis,
    typed_passes.NoPythonSupportedFeatureValidation,
    typed_passes.IRLegalization,
    typed_passes.AnnotateTypes,
)
"""What is done to a function before it is lowered. Numba's other passes are for closures and
comprehensions, which are refused without them, and for formulas of whole arrays.
"""


class QuickFlags(Flags):
    """Numba's flags, compared by those that are set: Numba compares half a million times.

    Flags that differ in a default that is set count as different: one more compilation at most.
    """

    def values(self):
        """Return what is set."""
        return dict(self._values)


@functools.cache
def _size(kind, target):
    """Return the bytes of a value: llvmlite has a module parsed whenever it is asked."""
    return kind.get_abi_size(target)


def _remembered(find):
    """Return numba's search ``find`` for the signature of a function for some types, so that for
    the same kernel flags it finds each once: Numba looks for 200 of them 9,000 times.

    Which code belongs to a signature Numba notes at each search, as it depends on the flags.
    """
    known = {}

    @functools.wraps(find)
    def found(function, context, args, kws):
        flags = ConfigStack.top_or_none()
        if kws or not isinstance(flags, QuickFlags):  # not ours
            return find(function, context, args, kws)
        what = id(function), context, tuple(args), flags
        remembered = known.get(what)
        if remembered is None:
            signature = find(function, context, args, kws)
            # with the function, so that its id is no other's
            remembered = known[what] = signature, function.get_impl_key(signature), function
        signature, code, _ = remembered
        function._impl_keys[signature.args] = code
        return signature

    return found


BaseFunction.get_call_type = _remembered(BaseFunction.get_call_type)


class QuickCompiler(CompilerBase):
    """Numba's compiler for functions of plain loops, with another ``lowering``."""

    def __init__(self, *given):
        super().__init__(*given)
        self.state.flags = QuickFlags(self.state.flags)
        context = self.state.targetctx
        context.get_abi_sizeof = lambda kind: _size(kind, context.target_data)

    def define_pipelines(self):
        """Return the passes, in order."""
        manager = PassManager("kernel")
        for step in (*PASSES, self.lowering, typed_passes.NoPythonBackend):
            manager.add_pass(step, step.name())
        manager.finalize()
        return [manager]
