"""Columns of the factor and their supernodes, against elimination in a dense pattern."""

import numpy as np
import pytest

from kernels.linear.supernodal.dissection import neighbours
from kernels.linear.supernodal.symbolic import columns, supernodes
from tests.support.kernels.supernodes import random_blocks


def filled(n, pairs, order):
    """Lower pattern (n, n) of the factor, by place in ``order``."""
    place = np.argsort(order)
    pattern = np.eye(n, dtype=bool)
    for i, j in pairs:
        pattern[place[i], place[j]] = pattern[place[j], place[i]] = True
    for k in range(n):
        below = np.flatnonzero(pattern[k + 1 :, k]) + k + 1
        pattern[np.ix_(below, below)] = True
    return np.tril(pattern)


def random_factor(seed, n):
    rng = np.random.default_rng(seed)
    sizes, pairs, _ = random_blocks(rng, n, 1.5 / n)
    order = rng.permutation(n)
    start, near = neighbours(n, pairs)
    return pairs, sizes[order], order, columns(start, near, order)


@pytest.mark.parametrize("n", [1, 2, 10, 60])
@pytest.mark.parametrize("seed", range(3))
def test_columns_are_the_true_fill(seed, n):
    pairs, _, order, (parent, first, row) = random_factor(seed, n)
    expected = filled(n, pairs, order)
    for j in range(n):
        below = np.flatnonzero(expected[j + 1 :, j]) + j + 1
        np.testing.assert_array_equal(row[first[j] : first[j + 1]], below)
        assert parent[j] == (below[0] if below.size else -1)


@pytest.mark.parametrize("n", [1, 2, 10, 60])
@pytest.mark.parametrize("seed", range(3))
def test_supernodes_hold_the_fill_of_their_own_order(seed, n):
    pairs, weight, order, found = random_factor(seed, n)
    start, block, below, rows, above = supernodes(*found, weight)
    np.testing.assert_array_equal(np.sort(block), np.arange(n))
    expected = filled(n, pairs, order[block])
    for s in range(len(start) - 1):
        inside = rows[below[s] : below[s + 1]]
        assert np.all(np.diff(inside) > 0)
        for j in range(start[s], start[s + 1]):
            needed = np.flatnonzero(expected[start[s + 1] :, j]) + start[s + 1]
            assert np.isin(needed, inside).all()
        if above[s] < 0:
            assert inside.size == 0
            continue
        up = above[s]
        assert up > s
        assert start[up] <= inside[0] < start[up + 1]
        known = np.append(np.arange(start[up], start[up + 1]), rows[below[up] : below[up + 1]])
        assert np.isin(inside, known).all()


def test_children_are_directly_before_their_parents():
    _, weight, _, found = random_factor(0, 60)
    *_, above = supernodes(*found, weight)
    size = np.ones(len(above), int)
    for s, up in enumerate(above):
        if up >= 0:
            size[up] += size[s]
    for s in range(len(above)):
        inside = s - np.arange(1, size[s])
        assert all(above[k] in range(s - size[s] + 1, s + 1) for k in inside)
