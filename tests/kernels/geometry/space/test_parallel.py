"""The factor that takes parallel edges out, and its derivatives."""

import numpy as np
import pytest

from kernels.geometry.space import parallel
from tests.support.kernels.terms import Term, derivative_error

NORMAL = (0.6, 0.0, 0.8)
SHARE = (0.3, 0.7, -0.4, -0.6)


def points_of(y):
    return tuple(tuple(row) for row in y.reshape(4, 3))


def factor_of(scale) -> Term:
    """The factor m as a function of four nodes."""

    def slope(y, g):
        value, first, _ = parallel.factor(points_of(y), scale)
        by_u, by_v = np.array(parallel.slopes(points_of(y)))
        g += first * np.concatenate([-by_u, by_u, -by_v, by_v])
        return value

    def second(y):
        K = np.zeros((12, 12))
        _, first, curvature = parallel.factor(points_of(y), scale)
        parallel.add(points_of(y), first, curvature, SHARE, NORMAL, 0.0, K)
        return K

    return Term(slope, second)


def edges(tilt):
    return np.array([0, 0, 0, 1, 0, 0.1, 0.2, 0.1, 0.4, 1.3, 0.1 + tilt, 0.51])


@pytest.mark.parametrize("tilt", [0.0, 1e-3, 0.05, 0.7])
@pytest.mark.parametrize("scale", [1e-3, 1.0])
def test_derivatives(tilt, scale):
    """Exactly parallel too."""
    step = 1e-4 * min(1.0, max(tilt, 1e-2))
    assert derivative_error(factor_of(scale), edges(tilt), 1.0, step) < 1e-6


def test_values():
    scale = 0.01
    at = {tilt: parallel.factor(points_of(edges(tilt)), scale) for tilt in (0.0, 0.05, 0.5)}
    assert at[0.0][0] == pytest.approx(0.0, abs=1e-10)
    c = np.linalg.norm(np.cross([1, 0, 0.1], [1.1, 0.05, 0.11])) ** 2
    assert at[0.05][0] == pytest.approx((2.0 - c / scale) * c / scale)
    assert at[0.5] == (1.0, 0.0, 0.0)


def test_the_mixed_part():
    K = np.zeros((12, 12))
    parallel.add(points_of(edges(0.2)), 0.0, 0.0, SHARE, NORMAL, 2.0, K)
    by_u, by_v = np.array(parallel.slopes(points_of(edges(0.2))))
    slope, push = np.concatenate([-by_u, by_u, -by_v, by_v]), np.kron(SHARE, NORMAL)
    np.testing.assert_allclose(K, 2.0 * (np.outer(slope, push) + np.outer(push, slope)))
