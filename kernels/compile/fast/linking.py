"""Numba's classes for compiled code, changed so that a kernel is optimised where it is linked.

Numba would optimise a function again in every function that calls it, directly or not. Here the
code of a kernel that other kernels call (`Linked`) is only tidied. It is optimised and becomes
machine code once, as a part of the kernel that Python calls (`Entry`).
"""

from llvmlite.binding import Linkage
from llvmlite.binding.newpassmanagers import create_new_module_pass_manager
from numba import _dynfunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler_machinery import register_pass
from numba.core.lowering import Lower
from numba.core.typed_passes import NativeLowering

from kernels.compile.fast.abi import ShortLower, is_short, register
from kernels.compile.fast.passes import QuickCompiler

WRAPPER = "_ZN7cpython"  # so begin the names of what Python calls
NOWHERE = 1  # an address that is not called
LARGE = 250  # lines of LLVM: a linked function that has more is not inlined


class Tidied(JITCodeLibrary):
    """Code that is only tidied before it is linked.

    Most of what Numba writes down takes named tuples apart and puts them together again.
    """

    def _optimize_functions(self, ll_module):
        ll_module.data_layout = self._codegen._data_layout
        tidy = create_new_module_pass_manager()
        tidy.add_aggressive_dce_pass()
        tidy.add_sroa_pass()
        tidy.add_instruction_combine_pass()
        tidy.run(ll_module, self._codegen._pass_builder())


class Linked(Tidied):
    """Code that is linked into the entries that reach it, and becomes machine code there."""

    def add_llvm_module(self, ll_module):
        """Take it in, for several to link."""
        super().add_llvm_module(ll_module)
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == Linkage.external:
                function.linkage = "linkonce_odr"
                if str(function).count("\n") > LARGE:
                    function.add_function_attribute("noinline")

    def finalize(self):
        """Leave it to the entries to link what this calls."""
        for library in self._linking_libraries:
            self._reload_init.update(library._reload_init)
        self._finalized = True

    def _reached(self, found):
        """Add the libraries of all that this calls to the dictionary ``found``; return it."""
        for library in self._linking_libraries:
            if library not in found:
                found[library] = None
                if isinstance(library, Linked):
                    library._reached(found)
        return found

    def _get_module_for_linking(self):
        """Return its module together with those of all that it calls, callers first."""
        if self._shared_module is None:
            self._shared_module = self._final_module.clone()
            for library in self._reached({}):
                linked = isinstance(library, Linked)
                module = library._final_module if linked else library._get_module_for_linking()
                self._shared_module.link_in(module, preserve=True)
        return self._shared_module


class Lowering(NativeLowering):
    """Numba's lowering but for how arguments are handed on."""

    lowering_class = Lower

    def run_pass(self, state):
        """Lower the function."""
        self.lowering_class = ShortLower if is_short(state.flags) else Lower
        return super().run_pass(state)


@register_pass(mutates_CFG=True, analysis_only=False)
class LinkedLowering(Lowering):
    """Numba's lowering to a library that callers link, with no address of its own."""

    _name = "linked_lowering"

    def run_pass(self, state):
        """Lower the function and make it known to its callers."""
        state.library = Linked(state.targetctx.codegen(), state.func_id.func_qualname)
        super().run_pass(state)
        lowered, context = state["cr"], state.targetctx
        name = lowered.fndesc.qualname
        key = _dynfunc.make_function(
            lowered.fndesc.lookup_module(), name, name, NOWHERE, lowered.env, (state.library,)
        )
        register(context, key, lowered.fndesc, [state.library], is_short(state.flags))
        state["cr"] = lowered._replace(cfunc=key)
        return True


class Entry(JITCodeLibrary):
    """Code that Python calls, with all that it calls itself.

    Named tuples of arrays are passed as their parts, hundreds of arguments. What is linked is made
    known to be called from nowhere else, so that LLVM drops those that are not used. What takes
    arguments from Python is not optimised: it runs once a call and is as long as many kernels.
    """

    def _optimize_functions(self, ll_module):
        written = [function for function in ll_module.functions if not function.is_declaration]
        wrappers = [function for function in written if function.name.startswith(WRAPPER)]
        for function in wrappers:
            function.add_function_attribute("optnone")
            function.add_function_attribute("noinline")
        if wrappers != written:
            super()._optimize_functions(ll_module)

    def _optimize_final_module(self):
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == Linkage.linkonce_odr:
                function.linkage = "internal"
        super()._optimize_final_module()


@register_pass(mutates_CFG=True, analysis_only=False)
class EntryLowering(Lowering):
    """Numba's lowering to an `Entry`."""

    _name = "entry_lowering"

    def run_pass(self, state):
        """Lower the function to code that can be kept."""
        state.library = Entry(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return super().run_pass(state)


class EntryCompiler(QuickCompiler):
    """Compiles what Python calls."""

    lowering = EntryLowering


class LinkedCompiler(QuickCompiler):
    """Compiles what is only linked."""

    lowering = LinkedLowering

    def __init__(self, *given):
        super().__init__(*given)
        self.state.flags.no_compile = True
