"""Conservative advancement: nothing meets within the share that is returned, and it is not less
than needed.
"""

import ipctk
import numpy as np
import pytest

from kernels.geometry.space import advancement
from kernels.geometry.space.advancement import KEPT
from kernels.geometry.space.closest import squared_between_edges, squared_to_triangle

KINDS = [
    (advancement.point_triangle, squared_to_triangle),
    (advancement.edge_edge, squared_between_edges),
]
TRIANGLE = np.array([[0.2, 0.3, 0.5], [0, 0, 0], [1, 0, 0], [0, 1, 0]])
EDGES = np.array([[-1, 0, 0.5], [1, 0.2, 0.5], [0, -1, 0], [0.1, 1, 0]])


def vectors(rows):
    return tuple(tuple(row) for row in rows)


def distance(squared, points, moves, s):
    return squared(*vectors(points + s * moves)) ** 0.5


@pytest.mark.parametrize("size", [1e-2, 1.0, 1e3, 1e6])
@pytest.mark.parametrize(("advance", "squared"), KINDS)
def test_random_moves_never_meet(advance, squared, size):
    """The distance along the whole share is at least the share that is kept."""
    full = 0
    for seed in range(150):
        rng = np.random.default_rng(seed)
        points, moves = rng.normal(size=(4, 3)), size * rng.normal(size=(4, 3))
        share = advance(vectors(points), vectors(moves), 1.0)
        full += share == 1.0
        assert 0.0 < share <= 1.0
        start = distance(squared, points, moves, 0.0)
        gaps = [distance(squared, points, moves, s) for s in np.linspace(0, share, 40)]
        assert min(gaps) >= (1.0 - 1e-9) * KEPT * start
    assert full > 148 if size < 0.1 else 100 < full < 140


@pytest.mark.parametrize("speed", [1e-3, 0.49, 0.52, 1.0, 10.0, 1e6])
@pytest.mark.parametrize(
    ("advance", "points"),
    [(advancement.point_triangle, TRIANGLE), (advancement.edge_edge, EDGES)],
)
def test_head_on(advance, points, speed):
    """Half a metre apart: all of the way is taken, less at most a tenth."""
    moves = np.zeros((4, 3))
    first = 1 if advance is advancement.point_triangle else 2
    moves[:first, 2] = -speed
    share = advance(vectors(points), vectors(moves), 1.0)
    meets = 0.5 / speed
    if meets > 1.2:
        assert share == 1.0
    else:
        assert (1.0 - 2.0 * KEPT) * meets < share < meets


@pytest.mark.parametrize(("advance", "squared"), KINDS)
def test_shares_against_the_toolkit(advance, squared):
    """Tight inclusion: the first meeting is never before the share, and seldom far beyond."""
    exact = ipctk.TightInclusionCCD()
    shares, hits = [], 0
    for seed in range(300):
        rng = np.random.default_rng(seed)
        points, moves = rng.normal(size=(4, 3)), 3.0 * rng.normal(size=(4, 3))
        share = advance(vectors(points), vectors(moves), 1.0)
        kind = "point_triangle" if squared is squared_to_triangle else "edge_edge"
        meets, time = getattr(exact, f"{kind}_ccd")(*points, *(points + moves))
        if meets:
            hits += 1
            shares.append(share / time)
            assert share <= time * (1.0 + 1e-6)
    assert hits > 15
    assert np.median(shares) > 0.8


@pytest.mark.parametrize(("advance", "squared"), KINDS)
def test_common_motion_does_not_count(advance, squared):
    points = np.random.default_rng(0).normal(size=(4, 3))
    moves = np.tile([1e3, -2e3, 5e2], (4, 1))
    assert advance(vectors(points), vectors(moves), 1.0) == 1.0
    assert advance(vectors(points), vectors(0.0 * moves), 1.0) == 1.0


@pytest.mark.parametrize("most", [1.0, 0.3, 1e-3])
def test_no_more_than_asked_for(most):
    moves = np.zeros((4, 3))
    moves[0, 2] = -1.0
    share = advancement.point_triangle(vectors(TRIANGLE), vectors(moves), most)
    assert share == min(most, advancement.point_triangle(vectors(TRIANGLE), vectors(moves), 1.0))
