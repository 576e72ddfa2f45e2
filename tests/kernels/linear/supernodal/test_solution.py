"""Solves with the factor of supernodes, and directions of negative curvature."""

import numpy as np
import pytest

from kernels.linear.supernodal.solution import descend
from tests.support.kernels.supernodes import (
    assembled,
    dominant,
    factored,
    random_blocks,
    random_dense,
    solved,
)


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("seed", range(4))
def test_descent_along_the_first_negative_pivot(seed, scale):
    rng = np.random.default_rng(seed)
    sizes, pairs, points = random_blocks(rng, 30, 0.05)
    full = dominant(random_dense(rng, sizes, pairs))
    bad = rng.integers(0, len(full))
    full[bad, bad] -= np.abs(full[bad]).sum() + rng.uniform(0.01, 3)
    full *= scale
    matrix = assembled(sizes, pairs, points, full)
    failed, pivot = factored(matrix, scale=scale)
    of = matrix.unknown
    minors = [np.linalg.eigvalsh(full[np.ix_(of[:k], of[:k])])[0] for k in range(1, len(of) + 1)]
    assert failed == of[next(k for k, least in enumerate(minors) if least < 0)] == bad
    d = np.full(len(full), 7.0)
    descend(matrix, d)
    assert pivot < 0
    assert d @ full @ d == pytest.approx(pivot, rel=1e-9)
    assert d[failed] == 1.0
    assert not d[of[matrix.home[failed] + 1 :]].any()


def test_parts_that_do_not_couple():
    rng = np.random.default_rng(4)
    sizes = rng.integers(1, 7, 30)
    pairs = np.array([(i, i + 2) for i in range(28)] + [(5, 5)])
    full = dominant(random_dense(rng, sizes, pairs[:-1]))
    matrix = assembled(sizes, pairs, rng.uniform(size=(30, 3)), full)
    assert factored(matrix) == (-1, 0.0)
    b = rng.uniform(-1, 1, len(full))
    np.testing.assert_allclose(solved(matrix, b), np.linalg.solve(full, b), rtol=0, atol=1e-13)
