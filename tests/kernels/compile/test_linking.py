"""Kernels that others call: tidied, linked, and compiled without interruption."""

import gc
import threading
import time
from contextlib import suppress
from typing import NamedTuple

import numba
import numpy as np
import pytest
from numba.extending import overload

from kernels.compile import linking
from kernels.compile.jit import jit, jit_owning
from kernels.compile.undisturbed import undisturbed

resource = pytest.importorskip("resource")  # Windows has none


class Pair(NamedTuple):
    """Data that kernels pass on."""

    first: np.ndarray
    second: np.ndarray


def test_linked_kernels_take_no_tuple_apart_in_vain():
    @jit
    def dot(pair):
        total = 0.0
        for k in range(pair.first.size):
            total += pair.first[k] * pair.second[k]
        return total

    @jit
    def squared(array):
        return dot(Pair(array, array))

    assert squared(np.arange(3.0)) == 5.0
    (compiled,) = dot.linked.overloads.values()
    code = str(compiled.library._final_module)
    assert "load double" in code
    assert "insertvalue" not in code
    assert "alloca {" not in code


@pytest.mark.parametrize(("large", "calls"), [(0, 1), (10_000, 0)])
def test_a_large_kernel_is_called_with_the_arguments_it_uses(monkeypatch, large, calls):
    monkeypatch.setattr(linking, "LARGE", large)

    @jit
    def first(pair, k):
        return pair.first[k]

    @jit
    def doubled(array, k):
        return 2.0 * first(Pair(array, array), k)

    assert doubled(np.arange(3.0), 2) == 4.0
    (compiled,) = doubled.entry.overloads.values()
    code = compiled.library.get_llvm_str()
    written = [line for line in code.splitlines() if line.startswith("define internal")]
    handed = [line.count(",") + 1 for line in written if "first" in line]
    assert len(handed) == calls
    assert all(count < 7 for count in handed)  # of fourteen


def probe():
    """A callee of a kernel, so that code runs while the kernel is compiled."""


@pytest.mark.parametrize("collects", [True, False])
def test_compiling_is_not_interrupted_by_the_garbage_collector(collects):
    seen = []

    @overload(probe)
    def _(x):
        seen.append(gc.isenabled())
        return (lambda x: x) if x == numba.types.float64 else None

    def probed(x):
        return probe(x)

    was = gc.isenabled()
    try:
        (gc.enable if collects else gc.disable)()
        assert jit(probed)(1.0) == 1.0
        assert gc.isenabled() is collects
        with pytest.raises(numba.TypingError):
            jit(probed)(None)
        assert gc.isenabled() is collects
    finally:
        (gc.enable if was else gc.disable)()
    assert seen
    assert not any(seen)


def test_the_collector_is_on_again_after_two_threads_have_compiled():
    """One that starts while the other is at it must not take the pause for the rule."""
    compiling, go_on = threading.Event(), threading.Event()

    @overload(probe)
    def _(x):
        compiling.set()
        go_on.wait(1.0)

    def probed(x):
        return probe(x)

    def slowly():
        with suppress(numba.TypingError):
            jit(probed)("text")

    assert gc.isenabled()
    first = threading.Thread(target=slowly)
    first.start()
    assert compiling.wait(5.0)
    second = threading.Thread(target=lambda: jit_owning(lambda x: x + 1.0)(1.0))
    second.start()
    time.sleep(0.05)  # it waits
    go_on.set()
    first.join()
    second.join()
    assert gc.isenabled()


def test_deep_calls_while_compiling_take_no_memory_from_the_system_again_and_again():
    def leaf():
        """One call of many."""

    def deeper(depth):
        for _ in range(300):
            leaf()
        return deeper(depth - 1) if depth else None

    leaf.__code__ = leaf.__code__.replace(co_stacksize=100)
    compiled = undisturbed(deeper)
    compiled(200)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    compiled(200)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before < 100
