"""Broad phase in space: every near pair is found once, and none that is far or shares a node."""

import numpy as np
import pytest

from kernels.geometry.space import near
from kernels.geometry.space.closest import squared_between_edges, squared_to_triangle
from kernels.geometry.space.vectors import SIZE, point
from tests.support.kernels.surfaces import placed


def scattered(seed, n=40, reach=5):
    """Coordinates of random nodes, and triangles and edges of nodes near in number."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1, 1, (n, 3))
    first = rng.integers(0, n, 2 * n)
    step = rng.integers(1, reach, (2 * n, 2))
    triangles = np.column_stack([first, first + step[:, 0], first + step.sum(axis=1)]) % n
    return points, triangles, np.ascontiguousarray(triangles[:, :2])


def triangles_near(x, n, triangles, radius):
    found = near.node_triangle(x, n, np.arange(n), triangles, radius)
    listed = list(zip(found[0].tolist(), found[1].tolist(), strict=True))
    assert len(listed) == len(set(listed))
    for (p, k), d in zip(listed, found[2], strict=True):
        corners = [point(x, i) for i in triangles[k]]
        assert d == pytest.approx(squared_to_triangle(point(x, p), *corners) ** 0.5, rel=1e-14)
    assert (np.diff(found[1]) >= 0).all()
    return set(listed)


def edges_near(x, edges, radius):
    found = near.edge_edge(x, edges, np.ones(len(edges)), radius)
    listed = list(zip(found[0].tolist(), found[1].tolist(), strict=True))
    assert len(listed) == len(set(listed))
    assert (found[0] < found[1]).all()
    return set(listed)


def all_triangles(x, n, triangles, radius):
    return {
        (p, k)
        for k, nodes in enumerate(triangles)
        for p in range(n)
        if p not in nodes
        and squared_to_triangle(point(x, p), *(point(x, i) for i in nodes)) < radius**2
    }


def all_edges(x, edges, radius):
    return {
        (e, f)
        for f in range(len(edges))
        for e in range(f)
        if not set(edges[e]) & set(edges[f])
        and squared_between_edges(*(point(x, i) for i in (*edges[e], *edges[f]))) < radius**2
    }


@pytest.mark.parametrize("radius", [1e-3, 0.1, 0.3, 1.0, 10.0])
@pytest.mark.parametrize("seed", range(2))
def test_against_all_pairs(seed, radius):
    points, triangles, edges = scattered(seed)
    x = placed(points)
    expected = all_triangles(x, 40, triangles, radius)
    assert triangles_near(x, 40, triangles, radius) == expected
    between = all_edges(x, edges, radius)
    assert edges_near(x, edges, radius) == between
    if radius == 0.3:
        assert 200 < len(expected) < 2500
        assert 200 < len(between) < 2500


def test_images_see_nothing_and_pairs_of_two_images_are_left_out():
    points, triangles, edges = scattered(4)
    x, original = placed(points), np.where(np.arange(40) < 25, np.arange(40), 3)
    node, triangle, _ = near.node_triangle(x, 40, original, triangles, 0.3)
    expected = {pair for pair in all_triangles(x, 40, triangles, 0.3) if pair[0] < 25}
    assert set(zip(node.tolist(), triangle.tolist(), strict=True)) == expected
    own = (np.arange(len(edges)) % 3 == 0).astype(float)
    one, two, _ = near.edge_edge(x, edges, own, 0.3)
    found = list(zip(one.tolist(), two.tolist(), strict=True))
    assert set(found) == {pair for pair in all_edges(x, edges, 0.3) if own[list(pair)].any()}
    assert 100 < len(found) == len(set(found))


@pytest.mark.parametrize(
    ("length", "flat"), [(1e-3, ()), (1e3, ()), *((1.0, f) for f in [(0,), (2,), (0, 1), (1, 2)])]
)
def test_in_other_units_far_from_the_origin_in_a_plane_and_on_a_line(length, flat):
    points, triangles, edges = scattered(7)
    points[:, flat] = 0.25
    x, radius = placed(length * (points + 30.0)), 0.2 * length
    assert triangles_near(x, 40, triangles, radius) == all_triangles(x, 40, triangles, radius)
    assert edges_near(x, edges, radius) == all_edges(x, edges, radius)


def test_nothing_is_near_nothing():
    x = placed(np.zeros((1, 3)))
    none = np.empty((0, 3), np.int64)
    assert [len(a) for a in near.node_triangle(x, 1, np.arange(1), none, 1.0)] == [0, 0, 0]
    assert [len(a) for a in near.edge_edge(x, none[:, :2], np.ones(0), 1.0)] == [0, 0, 0]


def test_longest_moves():
    move = np.zeros(3 * SIZE)
    move[SIZE : SIZE + 3] = 2.0, -3.0, 6.0
    move[3:6] = 50.0  # rotations do not count
    assert near.longest(move, 3) == 7.0
    assert near.farthest(move + 1.0, np.ones_like(move), 3) == pytest.approx(7.0)
