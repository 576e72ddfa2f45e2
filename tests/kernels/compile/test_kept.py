"""Which compiled kernels are cached, and which must not be."""

from typing import NamedTuple

import numpy as np

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
