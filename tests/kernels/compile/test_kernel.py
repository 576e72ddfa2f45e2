"""Operations that kernels of the fast compiler do not do."""

import numba
import numpy as np
import pytest

from kernels.compile.jit import jit, jit_exact, jit_owning


def product(x, n):
    return x * n


def test_a_constant_argument_makes_no_new_version():
    times = jit(product)

    @jit
    def sixfold(x):
        return times(x, 2) + times(x, 3) + times(x, 1)

    assert sixfold(1.5) == 9.0
    assert len(times.linked.signatures) == 1
    assert times.entry.signatures == []


def test_only_an_owning_kernel_may_make_an_array():
    def total(n):
        return np.ones(n).sum()

    for decorator in (jit, jit_exact):
        with pytest.raises(numba.TypingError, match=r"No implementation of function .*ones"):
            decorator(total)(3)
    assert jit_owning(total)(3) == 3.0


def test_an_owning_kernel_makes_arrays_whoever_calls_it_first():
    @jit_owning
    def total(n):
        return np.ones(n).sum()

    @jit
    def twice(n):
        return 2.0 * total(n)

    assert twice(3) == 6.0
