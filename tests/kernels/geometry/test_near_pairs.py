"""Broad phase: every near pair is found, and none that is far or shares a node."""

import numpy as np
import pytest

from kernels.geometry import near_pairs
from kernels.geometry.distance import squared_distance
from tests.support.kernels.frames import contact_of, frame, joint_of_four, shaken


def brute_force(x, edges, radius):
    n = x.size // 2
    return {
        (p, k)
        for k, (a, b) in enumerate(edges)
        for p in range(n)
        if p not in (a, b) and squared_distance(x, p, a, b) < radius**2
    }


def random_segments(rng, n, reach):
    """``n`` nodes and 2 n segments between nodes near in number."""
    first = rng.integers(0, n, 2 * n)
    second = (first + rng.integers(1, reach, 2 * n)) % n
    return np.column_stack([first, second])


def found(x, edges, radius):
    node, edge, distance = near_pairs.near(x, x.size // 2, edges, radius)
    for p, k, d in zip(node, edge, distance, strict=True):
        assert d == np.sqrt(squared_distance(x, p, *edges[k]))
    listed = list(zip(node.tolist(), edge.tolist(), strict=True))
    assert len(listed) == len(set(listed))
    return set(listed)


def in_two_clusters(x):
    return np.concatenate([1e-3 * x[:40], 1e-3 * x[40:] + 1.0])


@pytest.mark.parametrize(
    ("placed", "radius"),
    [
        *((lambda x: x, radius) for radius in (1e-3, 0.05, 0.3, 1.0, 10.0)),
        (lambda x: 1e-3 * (x + 3.0), 2e-4),
        (lambda x: 1e3 * (x + 3.0), 200.0),
        (lambda x: np.where(np.arange(80) % 2, x, 0.25), 0.1),  # on a line
        (lambda x: np.where(np.arange(80) % 2, 0.25, x), 0.1),
        (in_two_clusters, 2e-4),
    ],
)
def test_near_against_brute_force(placed, radius):
    rng = np.random.default_rng(0)
    x, edges = placed(rng.uniform(-1, 1, 80)), random_segments(rng, 40, 5)
    expected = brute_force(x, edges, radius)
    assert found(x, edges, radius) == expected
    if radius == 0.3:
        assert 50 < len(expected) < 80 * 38


def test_a_pair_at_the_radius_is_not_near():
    x = np.array([0.0, 0, 1, 0, 0.5, 0.25])
    assert found(x, np.array([[0, 1]]), 0.25) == set()
    assert found(x, np.array([[0, 1]]), np.nextafter(0.25, 1)) == {(2, 0)}


def test_find_gives_pairs_their_own_rules_if_they_are_special():
    """A wall bent back upon itself: its legs are ordinary pairs, but near the bend."""
    joints, walls = [(0, 0), (6, 0), (6, 1.0), (0, 1.0)], [(0, 1), (1, 2), (2, 3)]
    of = frame(joints, walls, [12, 2, 12], [0.8, 0.6, 0.4])
    contact = contact_of(of)
    mean = 0.5 * (contact.node_thickness[:, None] + of.thickness)
    listed = near_pairs.find(of.rest, contact, 2.0)
    owner = np.repeat(np.arange(len(of.edges)), np.diff(contact.special_start))
    seen = 0
    for k, (p, e) in enumerate(zip(listed.node, listed.edge, strict=True)):
        (at,) = np.nonzero((contact.special_node == p) & (owner == e))
        length, *subtract = near_pairs.counted(listed, k, contact)
        assert listed.rule[k] == (at[0] if len(at) else -1)
        assert listed.d_contact[k] > 0.0
        guarded = len(at) == 1 and contact.special_weight[at[0]] == 0.0
        assert near_pairs.is_guarded(listed, k, contact) == guarded
        if guarded:
            assert (length, *subtract) == (contact.tributary[p], 0.0, 0.0)
        if len(at):
            seen += 1
            assert guarded or length == contact.special_weight[at[0]]
            assert listed.d_contact[k] == contact.special_distance[at[0]]
            assert guarded or subtract == [*contact.special_subtract[at[0]]]
        else:
            assert (length, *subtract) == (contact.tributary[p], *contact.subtract[e])
            assert listed.d_contact[k] == pytest.approx(mean[p, e])
    assert 50 < seen < len(listed.node) - 50


@pytest.mark.parametrize("seed", range(3))
def test_find_lists_the_nearest_first(seed):
    of = joint_of_four()
    x = shaken(of, seed)
    listed = near_pairs.find(x, contact_of(of), 3.0)
    assert len(listed.node) > 20
    assert np.all(np.diff(listed.distance) >= 0.0)
    for p, k, d in zip(listed.node, listed.edge, listed.distance, strict=True):
        assert d <= np.sqrt(squared_distance(x, p, *of.edges[k])) < d + 3.1 / near_pairs.SHELLS
    for radius in (0.0, 0.5, 2.0, np.inf):
        ahead = near_pairs.within(listed, radius)
        assert np.all(listed.distance[:ahead] < radius)
        assert np.all(listed.distance[ahead:] >= radius)
    assert set(zip(listed.node.tolist(), listed.edge.tolist(), strict=True)) == brute_force(
        x[: 2 * len(of.points)], of.edges, 3.0
    )


def test_farthest_is_the_largest_move_of_a_node():
    x = np.zeros(9)
    moved = np.array([0.0, 0.1, 3.0, 4.0, 1.0, -1.0, 50.0, 0.0, 0.0])
    assert near_pairs.farthest(moved, x, 3) == pytest.approx(5.0)
    assert near_pairs.empty().node.size == 0
