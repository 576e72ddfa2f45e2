"""Optimises kernels when they are linked: once, in the kernel that Python calls.

Numba optimises a function and compiles it to machine code, and does both again in every function
that calls it, directly or not. Here a kernel that other kernels call (`Linked`) is only simplified;
the kernel that Python calls (`Entry`) contains everything that it reaches. LLVM then sees every
call, and knows that there are no others, so that it inlines more than it would across Numba's
libraries.

This is Numba's documented way to change a compiler (`pipeline_class`), but the methods that it
overrides are private ones of Numba's code library: see `choice.KNOWN` and README.md.
"""

from llvmlite.binding import Linkage
from llvmlite.binding.newpassmanagers import create_new_module_pass_manager
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import NativeLowering

WRAPPER = "_ZN7cpython"  # the names of functions that Python calls begin so
LARGE = 250  # lines of LLVM: a linked function that has more is not inlined
SHARED = (Linkage.weak_odr, Linkage.linkonce_odr)  # the one survives without a caller


class Linked(JITCodeLibrary):
    """Code of a kernel that entries link, without an address of its own."""

    def _optimize_functions(self, ll_module):
        """Take fewer named tuples apart and put fewer together, which is most of the code that
        Numba writes.
        """
        ll_module.data_layout = self._codegen._data_layout
        tidy = create_new_module_pass_manager()
        tidy.add_aggressive_dce_pass()
        tidy.add_sroa_pass()
        tidy.add_instruction_combine_pass()
        tidy.run(ll_module, self._codegen._pass_builder())

    def add_llvm_module(self, ll_module):
        """Add a module, for several entries to link."""
        super().add_llvm_module(ll_module)
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == Linkage.external:
                function.linkage = "weak_odr"
                if str(function).count("\n") > LARGE:
                    function.add_function_attribute("noinline")

    def finalize(self):
        """Leave the linking of callees to the entries."""
        for library in self._linking_libraries:
            self._reload_init.update(library._reload_init)
        self._finalized = True

    def _get_module_for_linking(self):
        return self._final_module


class Entry(JITCodeLibrary):
    """Code that Python calls, with all the code that it reaches.

    The unpacking of arguments from Python is not optimised: it runs once per call, and is as long
    as many kernels.
    """

    def _optimize_functions(self, ll_module):
        for function in ll_module.functions:
            if not function.is_declaration and function.name.startswith(WRAPPER):
                function.add_function_attribute("optnone")
                function.add_function_attribute("noinline")
        super()._optimize_functions(ll_module)

    def finalize(self):
        """Link all libraries that are reached, kernels first: LLVM drops functions of Numba's own
        that nothing calls yet.
        """
        reached = _reached(self, {})
        self._linking_libraries = sorted(reached, key=lambda one: not isinstance(one, Linked))
        super().finalize()

    def _optimize_final_module(self):
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage in SHARED:
                function.linkage = "internal"
        super()._optimize_final_module()


def _reached(library, reached):
    """Add all libraries that a library calls, directly or through kernels, to the dictionary
    ``reached``; return it.
    """
    for called in library._linking_libraries:
        if called not in reached:
            reached[called] = None
            if isinstance(called, Linked):
                _reached(called, reached)
    return reached


@register_pass(mutates_CFG=True, analysis_only=False)
class Lowering(NativeLowering):
    """Numba's lowering of a function, either to a library for linking or to an entry."""

    _name = "kernel_lowering"

    def run_pass(self, state):
        """Lower a function; one that takes no arguments from Python is linked.

        Callers find a linked function by a key, a builtin method as Numba's dispatcher requires,
        which is never called.
        """
        linked = state.flags.no_compile = state.flags.no_cpython_wrapper
        kind, name = Linked if linked else Entry, state.func_id.func_qualname
        state.library = kind(state.targetctx.codegen(), name)
        if not linked:
            state.library.enable_object_caching()
        super().run_pass(state)
        if linked:
            key, lowered = [state.library].copy, state["cr"]
            state.targetctx.insert_user_function(key, lowered.fndesc, [state.library])
            state["cr"] = lowered._replace(cfunc=key)
        return True


class Compiler(CompilerBase):
    """Numba's compiler with this lowering."""

    def define_pipelines(self):
        """Return the compiler's passes."""
        manager = DefaultPassBuilder.define_nopython_pipeline(self.state)
        manager.passes = [
            (Lowering if step is NativeLowering else step, why) for step, why in manager.passes
        ]
        return [manager]
