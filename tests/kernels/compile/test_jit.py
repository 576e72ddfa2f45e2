"""Compilation options, and a cache that is never stale."""

import math
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
import pytest

from kernels.compile.jit import jit, jit_exact


def plus_one(x):
    return x + 1.0


def rounding_error(a, b):
    total = a + b
    shift = total - a
    return (a - (total - shift)) + (b - shift)


def test_an_edited_callee_never_gives_an_old_value(package, run):
    assert run() == ["2.5", "0"]
    assert run() == ["2.5", "1"]
    callee = package / "callee.py"
    callee.write_text(callee.read_text().replace("1.0", "7.0"))
    assert run() == ["8.5", "0"]
    assert run(NUMBA_DISABLE_JIT="1") == ["8.5", "plain"]


def test_first_calls_from_many_threads():
    kernel = jit(plus_one)
    with ThreadPoolExecutor(8) as pool:
        values = list(pool.map(kernel, np.arange(64.0)))
    assert values == list(np.arange(1.0, 65.0))
    assert len(kernel.entry.signatures) == 1


def test_exact_kernels_keep_every_rounding():
    assert jit_exact(rounding_error)(1.0e16, 1.0) == rounding_error(1.0e16, 1.0) == 1.0


@pytest.mark.parametrize("decorator", [jit, jit_exact])
def test_kernels_see_nan_divide_like_numpy_and_release_the_lock(decorator):
    @decorator
    def ratio_is_nan(a, b):
        return math.isnan(a / b)

    assert ratio_is_nan(0.0, 0.0)
    assert not ratio_is_nan(1.0, 0.0)
    assert ratio_is_nan.entry.targetoptions["nogil"] is True


def test_a_kernel_called_by_kernels_can_be_called_from_python_too(run):
    """Both versions of its code are kept: neither is taken for the other."""
    script = (
        "from kernels.caller import value; from kernels.callee import offset; "
        "print(value(1.0), offset(1.0), offset.entry.stats.cache_hits.total())"
    )
    assert [run(script) for _ in range(2)] == [["2.5", "2.0", "0"], ["2.5", "2.0", "1"]]
    only = "from kernels.callee import offset; print(offset(1.0), *offset.linked.signatures)"
    assert run(only) == ["2.0"]


def product(x, n):
    return x * n


def test_a_kernel_that_does_not_compile_says_where():
    """The message names the operation, its types, the function and its caller; and again next
    time.
    """
    times = jit(product)

    @jit
    def nonsense(x):
        return times(x, None)

    for _ in range(2):
        with pytest.raises(numba.TypingError) as failure:
            nonsense(1.5)
        for part in ("mul(float64, none)", "def product(x, n)", "def nonsense(x)"):
            assert part in str(failure.value)
    assert times(1.5, 2) == 3.0
