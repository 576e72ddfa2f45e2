"""Bundles: every wall that is not rigid is in one lane, beside walls of its kind and length."""

from itertools import pairwise

import numpy as np
import pytest

from kernels.compile.simd import LANES
from kernels.linear.condensed.bundles import RIGID, bundled

NODE, OUTER = 3, 6


def made(kind, pieces):
    """Bundles of walls, and the coordinates inside and at the ends of each."""
    start = np.append(0, np.cumsum(pieces))
    row_start = np.append(0, np.cumsum(NODE * (pieces - 1)))
    inner, outer = 100 + np.arange(row_start[-1]), np.arange(OUTER * kind.size).reshape(-1, OUTER)
    inside = [inner[a:b] for a, b in pairwise(row_start)]
    return bundled(kind, start, row_start, inner, outer), start, inside, outer


@pytest.mark.parametrize("seed", range(5))
def test_walls_are_beside_their_like(seed):
    rng = np.random.default_rng(seed)
    kind, pieces = rng.integers(0, 3, 23), rng.integers(1, 4, 23)
    bundles, start, inside, outer = made(kind, pieces)
    met = []
    for g in range(bundles.size.size):
        rows = bundles.inner.reshape(-1, LANES)[bundles.start[g] : bundles.start[g + 1]]
        ends = bundles.outer[g].reshape(OUTER, LANES)
        for lane, w in enumerate(bundles.wall[g]):
            assert (kind[w], pieces[w]) == (kind[bundles.wall[g, 0]], bundles.pieces[g])
            assert bundles.first[g, lane] == start[w]
            np.testing.assert_array_equal(rows[:, lane], inside[w])
            np.testing.assert_array_equal(ends[:, lane], outer[w])
            if lane < bundles.size[g]:
                assert bundles.place[w] == LANES * g + lane
                met.append(w)
            else:
                assert w == bundles.wall[g, bundles.size[g] - 1]
    assert sorted(met) == np.flatnonzero(kind != RIGID).tolist()
    assert (bundles.place[kind == RIGID] == -1).all()


def test_only_the_last_bundle_of_its_kind_is_incomplete():
    bundles = made(np.zeros(9, np.int64), np.full(9, 3))[0]
    np.testing.assert_array_equal(bundles.size, [4, 4, 1])
    np.testing.assert_array_equal(bundles.wall[:2].ravel(), range(8))


def test_without_walls_there_are_none():
    assert made(np.empty(0, np.int64), np.empty(0, np.int64))[0].size.size == 0
