"""Vectors of four: how they load, compute and store, and which types they refuse."""

import numba
import numpy as np
import pytest

from kernels.compile.jit import jit
from kernels.compile.simd import exceeds, exponent, lane, load, nearest, scaled, spread, store
from kernels.linear.condensed import block_ldlt, block_matrix, periodic_images


def combined(array, at, factor, to):
    store(array, to, load(array, to) + spread(factor) * load(array, at))


@pytest.mark.parametrize(("at", "to"), [(0, 4), (3, 4), (1, 0), (4, 4)])
def test_four_entries_are_loaded_computed_with_and_stored(at, to):
    rng = np.random.default_rng(at)
    array = rng.uniform(-1, 1, 8)  # the last four end with it
    expected = array.copy()
    expected[to : to + 4] += 3.0 * array[at : at + 4]
    jit(combined)(array, at, 3.0, to)
    np.testing.assert_allclose(array, expected, rtol=1e-15)


def all_exceed(array, bound):
    return exceeds(load(array, 0), spread(bound) - spread(1.0))


@pytest.mark.parametrize(
    ("lowest", "found"), [(3.0, True), (2.0, False), (1.0, False), (np.nan, False)]
)
@pytest.mark.parametrize("lane", range(4))
def test_what_exceeds_does_so_in_all_lanes(lane, lowest, found):
    array = np.full(4, 5.0)
    array[lane] = lowest
    for kernel in (jit(all_exceed), all_exceed):
        assert kernel(array, 3.0) is found


def taken_apart(array, at):
    numbers = load(array, 0)
    k = exponent(numbers)
    rest = scaled(numbers, spread(0.0) - k)
    return lane(k, at), lane(rest, at), lane(scaled(rest, k), at), lane(nearest(numbers), at)


@pytest.mark.parametrize("kernel", [jit(taken_apart), taken_apart], ids=["compiled", "plain"])
def test_numbers_are_taken_apart_into_a_power_of_two_and_a_rest_near_one(kernel):
    rng = np.random.default_rng(7)
    for array in np.exp(rng.uniform(-20.0, 20.0, (50, 4))):
        for at, number in enumerate(array.tolist()):
            k, rest, again, whole = kernel(array, at)
            assert k == round(np.log2(number))
            assert rest == number / 2.0**k
            assert again == number
            assert whole == round(number)


@pytest.mark.parametrize(
    "array",
    [np.zeros(8, np.float32), np.zeros(8, np.int64), np.zeros((8, 8)), np.zeros(16)[::2]],
    ids=["single", "integer", "plane", "gaps"],
)
def test_only_a_vector_of_float64_without_gaps_is_taken(array):
    with pytest.raises(numba.TypingError, match="load"):
        jit(combined)(array, 0, 3.0, 0)


def test_blocks_are_updated_four_numbers_at_a_time():
    pattern = np.array([0, 1, 1]), np.array([1])
    matrix = block_matrix.zero_matrix(np.arange(6), *pattern, np.ones(6), periodic_images.NONE)

    @jit
    def update(matrix):
        return block_ldlt._update(matrix, 0, 2, 0)

    assert update(matrix) == 1
    (compiled,) = update.entry.overloads.values()
    assert "fmul contract <4 x double>" in compiled.library.get_llvm_str()
