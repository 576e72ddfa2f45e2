"""How far a move may go: surfaces do not cross, nodes do not pass platens."""

import numpy as np
import pytest

from kernels.geometry.space import advancement, near
from kernels.geometry.space.vectors import SIZE
from kernels.plates.contacts import admissible, pairs
from kernels.shared.moves import ADVANCE
from tests.support.kernels.surfaces import (
    Sheet,
    between_platens,
    contact_of,
    crossings,
    pairs_of,
    placed,
    positions,
    two_sheets,
    two_triangles,
    wavy,
)


def test_the_least_gap_of_parallel_sheets():
    x, touch = two_sheets(0.4, Sheet(3, 3, 4, 4), Sheet(2, 2, 3, 3))
    assert admissible.least_gap(x, touch, pairs_of(x, touch), 0.0) == pytest.approx(0.4)


def advanced(x, dx, touch):
    """Coordinates after the admissible share of a move, and that share."""
    far = near.longest(dx, len(touch.area))
    listed = pairs.find(x, touch, touch.reach + 2.0 * far)
    share = admissible.step_limit(x, dx, far, touch, listed, 0.0)
    return x + share * dx, share


@pytest.mark.parametrize("speed", [0.1, 1.0, 30.0, 1e4])
def test_no_move_makes_surfaces_cross(speed):
    """Random and common moves of all nodes of two sheets, at any size."""
    limited = 0
    for seed in range(6):
        x, touch = wavy(seed, 0.5, 0.1)
        rng = np.random.default_rng(seed)
        for turn in range(5):
            dx = np.zeros_like(x)
            dx[:-2].reshape(-1, SIZE)[:, :3] = rng.normal(size=positions(x).shape)
            if turn % 2:
                dx[:-2].reshape(-1, SIZE)[9:, 2] -= 5.0
            x, share = advanced(x, speed * dx, touch)
            limited += share < 1.0
            assert share > 0.0
            assert crossings(x, touch) == (0, 0)
            assert admissible.least_gap(x, touch, pairs_of(x, touch), 0.0) > 0.0
    assert limited > 10


@pytest.mark.parametrize("speed", [0.3, 3.0, 3e3])
def test_an_edge_does_not_pass_an_edge(speed):
    """Ridges at right angles, pressed upon each other with all nodes far away."""
    x, touch = two_triangles(
        [[-2, 0, 0], [2, 0, 0], [0, 0, -5.0]], [[0, -2, 0.4], [0, 2, 0.4], [0, 0, 5]]
    )
    dx = np.zeros_like(x)
    dx[SIZE * np.arange(3, 6) + 2] = -speed
    for _ in range(4):
        x, share = advanced(x, dx, touch)
        assert crossings(x, touch) == (0, 0)
        assert x[SIZE * 3 + 2] > 0.0
    assert share < 1.0


def test_a_node_does_not_pass_a_rim():
    sheet = Sheet(2, 2)
    points = np.vstack([sheet.points, [(1.4, 0.5, 0.01), (1.6, 0.3, 0.8), (1.6, 0.8, 0.9)]])
    triangles = np.vstack([sheet.triangles, [(9, 10, 11)]])
    touch = contact_of(points, triangles, np.ones(12), 0.2)
    x, dx = placed(points), np.zeros(12 * SIZE + 2)
    dx[SIZE * 9 : SIZE * 9 + 3] = -0.8, 0.0, -0.04
    at, share = advanced(x, dx, touch)
    assert crossings(x + dx, touch)[0] > 0
    assert share < 1.0
    assert crossings(at, touch) == (0, 0)


def test_nodes_stop_before_platens():
    x, touch = between_platens(-0.05, 3.07)
    dx = np.zeros_like(x)
    dx[-2] = 0.5
    _, share = advanced(x, dx, touch)
    assert share == pytest.approx(ADVANCE * 0.1)
    assert admissible.least_gap(x, touch, pairs_of(x, touch), 0.0) == pytest.approx(0.05)
    dx[-2], dx[-1] = 0.0, -7.0
    assert advanced(x, dx, touch)[1] == pytest.approx(ADVANCE * 0.01)
    dx[-1] = 1.0
    assert advanced(x, dx, touch)[1] == 1.0


def test_part_of_a_distance_is_kept():
    x, touch = two_sheets(0.5, Sheet(2, 2, 3, 3), Sheet(1, 1, 2, 2, (0.4, 0.4, 0)))
    dx = np.zeros_like(x)
    dx[:-2].reshape(-1, SIZE)[9:, 2] = -1.0
    at, _ = advanced(x, dx, touch)
    gap = admissible.least_gap(at, touch, pairs_of(at, touch), 0.0)
    assert advancement.KEPT * 0.5 * (1 - 1e-12) <= gap < 0.1
