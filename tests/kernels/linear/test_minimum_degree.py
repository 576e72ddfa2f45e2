"""Order of elimination: least degree first, and the pattern that it leaves is the true fill."""

import numpy as np
import pytest

from kernels.linear import minimum_degree

SIZES = [1, 2, 5, 63, 64, 65, 100, 127, 128, 129, 150, 200]


def random_graph(seed, n):
    """Symmetric (n, n) pattern, a few neighbours to each, some far apart in number."""
    rng = np.random.default_rng(seed)
    joined = rng.uniform(size=(n, n)) < 1.5 / n
    joined |= joined.T
    np.fill_diagonal(joined, False)
    return joined


def grid_graph(n):
    """A square grid of about ``n`` points."""
    side = max(round(n**0.5), 1)
    points = np.arange(side * side).reshape(side, side)
    joined = np.zeros((side * side, side * side), dtype=bool)
    for a, b in ((points[:, 1:], points[:, :-1]), (points[1:], points[:-1])):
        joined[a, b] = joined[b, a] = True
    return joined


def bits_of(joined):
    bits = minimum_degree.graph(len(joined))
    for i, j in zip(*np.nonzero(joined), strict=True):
        minimum_degree.connect(bits, i, j)
    return bits


def eliminated(joined, sequence):
    """Columns of the factor (n, n) in that sequence, and the degrees met on the way."""
    left, pattern, degrees = joined.copy(), np.zeros_like(joined), []
    alive = np.ones(len(joined), dtype=bool)
    for position, v in enumerate(sequence):
        degrees.append(np.where(alive, left.sum(axis=1), len(joined)))
        around = np.flatnonzero(left[v])
        pattern[around, position] = True
        left[np.ix_(around, around)] = True
        left[around, around] = left[v] = left[:, v] = alive[v] = False
    return pattern[sequence], degrees


@pytest.mark.parametrize("kind", [lambda n: random_graph(n, n), grid_graph], ids=["random", "grid"])
@pytest.mark.parametrize("n", SIZES)
def test_the_pattern_of_the_factor_is_the_true_fill(n, kind):
    joined = kind(n)
    bits = bits_of(joined)
    sequence = minimum_degree.minimum_degree(bits)
    start, row = minimum_degree.columns(bits, sequence)
    np.testing.assert_array_equal(np.sort(sequence), np.arange(len(joined)))
    expected, _ = eliminated(joined, sequence)
    found = np.zeros_like(joined)
    found[row, np.repeat(np.arange(len(joined)), np.diff(start))] = True
    np.testing.assert_array_equal(found, expected)
    assert (start[0], start[-1]) == (0, len(row)) == (0, expected.sum())
    for p in range(len(joined)):
        assert np.all(np.diff(row[start[p] : start[p + 1]]) > 0)


@pytest.mark.parametrize("n", [5, 64, 100, 150])
def test_the_next_one_has_the_least_degree_that_is_left(n):
    joined = grid_graph(n)
    sequence = minimum_degree.minimum_degree(bits_of(joined))
    _, degrees = eliminated(joined, sequence)
    for v, degree in zip(sequence, degrees, strict=True):
        assert degree[v] == degree.min()
