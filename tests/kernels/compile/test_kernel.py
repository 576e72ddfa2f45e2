"""Which compiled kernels are cached, and operations that kernels do not do."""

from typing import NamedTuple

import numba
import numpy as np
import pytest

from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.compile.kernel import Kernel, is_of_kernels
from kernels.compile.reference import by_reference
from kernels.solve.problem import Evaluation


class Pair(NamedTuple):
    """A tuple whose verbs are not in the hash of the sources of kernels."""

    first: object
    second: float


def first(pair):
    return pair[0]


def second(pair):
    return pair.second


def compiled(function):
    return Kernel(function, fastmath=False, owning=True)


def kept(folder):
    return len([*folder.rglob("*.nbc")])


def test_what_is_compiled_for_tuples_from_elsewhere_is_not_kept(cache):
    kernel = compiled(first)
    assert kernel(Pair(2.0, 3.0)) == 2.0
    assert kernel((Pair(2.0, 3.0), 1)) == (2.0, 3.0)
    assert compiled(second)(by_reference(Pair(2.0, 3.0))) == 3.0
    assert kept(cache) == 0
    assert kernel((2.0, 1)) == 2.0
    assert kept(cache) == 1


def test_tuples_of_kernels_are_known():
    array = np.zeros(1)
    found = Evaluation(*[array] * len(Evaluation._fields))
    assert is_of_kernels(found)
    assert is_of_kernels(by_reference(found))
    assert not is_of_kernels(found._replace(u=Pair(array, 1.0)))


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
