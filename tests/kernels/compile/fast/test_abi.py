"""Arrays that kernels hand on by address and shape are the same on the other side."""

from typing import NamedTuple

import numba
import numpy as np
import pytest

from kernels.compile.jit import jit_exact, jit_owning


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    """Folder that kernels decorated from here on are kept in."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))


class Both(NamedTuple):
    """What a kernel is handed: a tuple in a tuple."""

    array: np.ndarray
    more: tuple


def _told(array):
    """Sum with weights that no two entries share, sizes, and strides where there are any."""
    total, weight = 0.0, 1.0
    for entry in array.flat:
        total += weight * entry
        weight *= 1.5
    apart = array.strides if array.size > 0 else array.shape
    return total, array.size, array.itemsize, array.shape, apart


BLOCK = np.arange(24.0).reshape(2, 3, 4) + 1.0
ARRAYS = {
    "vector": BLOCK[0, 0],
    "none": np.zeros(0),
    "matrix": BLOCK[1],
    "no rows": np.zeros((0, 3)),
    "three axes": BLOCK,
    "a column": BLOCK[1, :, 2],
    "backwards": BLOCK[0, 0, ::-1],
    "columns first": np.asfortranarray(BLOCK[0]),
    "integers": np.arange(5),
    "booleans": np.array([True, False, True]),
    "one number": np.array(3.0),
}


@pytest.mark.parametrize("array", ARRAYS.values(), ids=ARRAYS)
@pytest.mark.parametrize("decorator", [jit_exact, jit_owning])
def test_an_array_arrives_as_it_was(array, decorator):
    told = decorator(_told)

    @jit_exact
    def handed(both):
        return told(both.array), told(both.more[1]), both.more[0]

    expected = _told(array)
    assert handed(Both(array, (7, array))) == (expected, expected, 7)


def test_what_is_written_to_it_stays():
    @jit_exact
    def write(both, k):
        both.array[k, 1] = both.more[0]

    @jit_owning
    def filled(n):
        array = np.zeros((n, 2))
        for k in range(n):
            write(Both(array, (k + 1, k)), k)
        return array

    assert filled(3).tolist() == [[0.0, 1.0], [0.0, 2.0], [0.0, 3.0]]
