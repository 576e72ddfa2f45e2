"""Joints are not contacts: free of force at rest, weighted along the network, counted once."""

import numpy as np
import pytest

from kernels.geometry import near_pairs
from kernels.laws.barrier import barrier
from kernels.terms import contact
from tests.support.kernels.frames import (
    carried,
    contact_of,
    frame,
    grid,
    joint_of_four,
    only,
)
from tests.support.kernels.terms import touch_of

T = 0.8


def star(*bearings, pieces=3, thickness=T):
    """Walls of 4 mm that leave one joint in these directions (degrees)."""
    ends = [(4 * np.cos(np.radians(b)), 4 * np.sin(np.radians(b))) for b in bearings]
    return frame([(0, 0), *ends], [(0, i + 1) for i in range(len(ends))], pieces, thickness)


def zigzag(pieces):
    """Walls that are nearer to one another at rest than they are thick."""
    return frame(
        [(0, 0), (4, 0), (4, 0.3), (0, 0.5)], [(0, 1), (1, 2), (2, 3)], [pieces, 1, pieces]
    )


FRAMES = {
    "L": lambda n: star(0, 90, pieces=n),
    "T": lambda n: star(0, 180, 90, pieces=n),
    "X": lambda n: star(0, 90, 180, 270, pieces=n),
    "acute 60": lambda n: star(0, 60, pieces=n),
    "acute 30": lambda n: star(0, 30, pieces=n),
    "acute 15": lambda n: star(0, 15, 30, pieces=n),
    "mixed": lambda n: star(0, 45, 200, pieces=[n, 2 * n, n], thickness=[0.8, 0.4, 1.2]),
    "zigzag": zigzag,
    "grid": lambda n: grid(3, 12.5, n),
}


def rules(touch, p):
    """Weight, distance of contact and subtraction of node ``p`` against every element."""
    weight = np.full(len(touch.edges), touch.tributary[p])
    distance = 0.5 * (touch.node_thickness[p] + touch.edge_thickness)
    subtract = touch.subtract.copy()
    own = touch.special_node == p
    e = np.repeat(np.arange(len(touch.edges)), np.diff(touch.special_start))[own]
    weight[e], distance[e] = touch.special_weight[own], touch.special_distance[own]
    subtract[e] = touch.special_subtract[own]
    return weight, distance, subtract


@pytest.mark.parametrize("pieces", [1, 3, 12])
@pytest.mark.parametrize("name", FRAMES)
def test_the_rest_state_is_free_of_contact(name, pieces):
    of = FRAMES[name](pieces)
    touch = contact_of(of)
    for turn in (0.0, 0.3):
        x = carried(of, of.rest, turn)
        listed = near_pairs.find(x, touch, 2.0 * touch.reach)
        assert np.any(listed.d_contact > 0) or pieces == 1
        assert touch_of(touch, listed, x).energy(x) == 0.0
        assert not touch_of(touch, listed, x).gradient(x).any()
    assert contact.least_gap(of.rest, touch, listed, 0.0) > 0


@pytest.mark.parametrize("pieces", [1, 3, 12])
@pytest.mark.parametrize("name", FRAMES)
def test_every_vertex_is_counted_once_by_its_heaviest_element(name, pieces):
    """Left aside: the ends of a node's own elements where these are longer than 3 t.

    There nothing is reduced, and the end is nearer than t only when two thirds are crushed away.
    """
    of = FRAMES[name](pieces)
    touch = contact_of(of)
    checked = 0
    for p in range(len(of.points)):
        weight, _, subtract = rules(touch, p)
        own = np.any(of.edges == p, axis=1)
        long = own & (of.l0 > 3 * 0.5 * (touch.node_thickness[p] + of.thickness))
        for v in set(range(len(of.points))) - {p, *of.edges[long].ravel().tolist()}:
            element, side = np.nonzero((of.edges == v) & ~own[:, None])
            if element.size:
                kept = element[subtract[element, side] == 0.0]
                assert len(kept) == 1
                assert weight[kept[0]] == weight[element].max()
                checked += 1
    assert checked > 10 or pieces < 3


def excess(of, one, p, two):
    """tan(tau/2) - tau/2 of the turn from element ``one`` to ``two`` at node ``p``."""
    at = of.points @ [1.0, 1.0j]
    before, after = (of.edges[k].sum() - p for k in (one, two))
    turn = np.angle((at[after] - at[p]) / (at[p] - at[before]))
    return np.tan(turn / 2) - turn / 2


def paths(of, e):
    """Shortest path from element ``e`` to every node, by trying all: length, sum of excesses, last
    element.
    """
    found = {}

    def walk(p, last, length, corners):
        if p in found and length >= found[p][0]:
            return
        found[p] = length, corners, last
        for k in np.flatnonzero(np.any(of.edges == p, axis=1)):
            if k != last:
                walk(of.edges[k].sum() - p, k, length + of.l0[k], corners + excess(of, last, p, k))

    for p in of.edges[e]:
        walk(p, e, 0.0, 0.0)
    return found


def far_part(of, p, e, t, samples=400):
    """Tributary length of node ``p`` farther than D along the network from ``e``; its mean path."""
    found, total, moment = paths(of, e), 0.0, 0.0
    for k in np.flatnonzero(np.any(of.edges == p, axis=1)):
        s = (np.arange(samples) + 0.5) / samples * 0.5 * of.l0[k]
        far, least = np.ones(samples, bool), np.full(samples, np.inf)
        for v, along in ((p, s), (of.edges[k].sum() - p, of.l0[k] - s)):
            length, corners, last = found[v]
            corners += 0.0 if k == last else excess(of, last, v, k)
            far &= length + along > t * (np.pi / 2 + abs(corners))
            least = np.minimum(least, length + along)
        total += 0.5 * of.l0[k] * np.mean(far)
        moment += 0.5 * of.l0[k] * np.mean(far * least)
    return total, moment / total if total > 0.0 else np.inf


@pytest.mark.parametrize("of", [joint_of_four(), star(0, 30, 90, pieces=[1, 4, 9]), zigzag(5)])
def test_weights_and_distances_against_paths_along_the_network(of):
    touch = contact_of(of)
    reduced = shifted = 0
    for p in range(len(of.points)):
        weight, distance, _ = rules(touch, p)
        for e in np.flatnonzero(~np.any(of.edges == p, axis=1)):
            t = 0.5 * (touch.node_thickness[p] + touch.edge_thickness[e])
            expected, path = far_part(of, p, e, t)
            assert weight[e] == pytest.approx(expected, abs=2.0 * of.l0.max() / 400)
            reduced += expected < 0.99 * touch.tributary[p]
            if 0.1 * touch.tributary[p] < expected < 0.99 * touch.tributary[p]:
                starts = t * min(paths(of, e)[p][0], path) / np.hypot(path, t)
                starts = starts if path < 5.0 * t else t
                rest = least_distance(of, of.rest, p, [e])
                shifted += rest >= starts
                expected = starts if rest >= starts else 0.9 * rest
                assert distance[e] == pytest.approx(expected, rel=1e-2)
    assert reduced > 10
    assert shifted > 2


@pytest.mark.parametrize("opening", [30.0, 60.0, 90.0, 120.0, 180.0])
def test_faces_round_a_corner_touch_where_they_can_be_bent_to(opening):
    """They touch where paths are longer than t (cot(g/2) + g/2), g the opening of the arms."""
    of, half = star(0.0, opening, pieces=16), np.radians(opening) / 2
    touch, h = contact_of(of), 4.0 / 16
    least = T * (1 / np.tan(half) + half)
    node = np.append(np.flatnonzero(of.points[:, 1] == 0.0)[2:], 1)  # along the first wall
    for p in node:
        s = of.points[p, 0]
        expected = np.clip(s + h / 2 - (least - h * np.arange(16)), 0.0, h if s < 4.0 else h / 2)
        found = rules(touch, p)[0][16:]
        np.testing.assert_allclose(found, np.minimum(expected, touch.tributary[p]), atol=1e-12)


@pytest.mark.parametrize("pieces", [2, 7, 30])
@pytest.mark.parametrize("opening", [12.0, 45.0, 60.0, 90.0, 135.0])
def test_what_touches_was_apart(opening, pieces):
    """At rest, arms are apart by cos(g/2) + g/2 sin(g/2) times the distance of contact at least."""
    of, half = star(0.0, opening, pieces=pieces), np.radians(opening) / 2
    touch, least = contact_of(of), np.cos(half) + half * np.sin(half)
    checked = 0
    for p in range(len(of.points)):
        weight, distance, _ = rules(touch, p)
        for e in np.flatnonzero((weight > 0.0) & ~np.any(of.edges == p, axis=1)):
            rest = least_distance(of, of.rest, p, [e])
            assert rest > (1.0 - 1e-12) * least * distance[e]
            checked += 1
    assert checked > 3


def folded(of, pieces, opening):
    """State of a `star` of two walls after the second has turned rigidly to an ``opening``."""
    x, turned = of.rest.copy(), of.edges[pieces:, 1]
    away = np.linalg.norm(of.points[turned], axis=1)
    x[2 * turned] = away * np.cos(opening)
    x[2 * turned + 1] = away * np.sin(opening)
    return x


FIRST = 2 * np.arctan(1 / (1 + np.pi / 4))  # of a right angle: its faces touch at t (1 + pi/4) / 2


def test_contact_of_a_closing_corner_converges():
    """It is nothing at first, and energies are of the first order in the element at least."""
    energies = []
    for pieces in (12, 24, 48, 96):
        of = star(0.0, 90.0, pieces=pieces)
        touch = contact_of(of)
        states = [folded(of, pieces, FIRST + np.radians(turn)) for turn in (1, -6, -30, -40)]
        pairs = [near_pairs.find(x, touch, 2.0) for x in states]
        found = [touch_of(touch, *at).energy(at[1]) for at in zip(pairs, states, strict=True)]
        assert found[0] == 0.0
        assert np.all(np.diff(found) >= 0.0)
        energies.append(found[2:])
    change = np.abs(np.diff(energies, axis=0)) / energies[-1]
    assert np.all(change[2] < 0.04)
    assert np.all(change[2] < 0.7 * change[1])


def test_no_contact_starts_beyond_the_thickness_of_the_walls():
    """Walls that leave a sharp corner and bend apart: neighbour lists reach one thickness far."""
    ends = [(3 + 4 * np.cos(1.2), -4 * np.sin(1.2)), (3, 0), (0, 0), (3, 0.26)]
    ends.append((3 + 4 * np.cos(1.2), 0.26 + 4 * np.sin(1.2)))
    of = frame(ends, [(0, 1), (1, 2), (2, 3), (3, 4)], 6)
    touch = contact_of(of)
    _, distance, _ = rules(touch, 0)
    assert distance.max() == pytest.approx(T)
    listed = near_pairs.find(of.rest, touch, 100.0)
    apart = listed.distance > 5.0 * T
    assert np.any(touch.special_weight[listed.rule[apart & (listed.rule >= 0)]] == 0.0)
    assert listed.d_contact.max() <= touch.reach


def polyline(rng, rise):
    """A wall of unequal elements with stubs below, and a node (the last joint but one) above it.

    ``rise``: how far inner points of the wall are above its ends (convex towards the node).
    """
    along = np.concatenate([[0.0], np.sort(rng.uniform(0.5, 9.5, 6)), [10.0]])
    line = [(s, rise * s * (10.0 - s)) for s in along]
    stubs = [(s, y - 3.0) for s, y in line[2:5]]
    walls = [(i, i + 1) for i in range(7)] + [(i + 2, 8 + i) for i in range(3)]
    order = rng.permutation(len(walls))
    mover = [(5.0, 40.0), (5.0, 43.0)]
    walls = [walls[i] for i in order] + [(11, 12)]
    pieces = [*rng.integers(1, 4, len(walls) - 1), 1]
    return frame([*line, *stubs, *mover], walls, pieces), 11


@pytest.mark.parametrize("rise", [0.0, 0.04])
@pytest.mark.parametrize("seed", range(6))
def test_a_node_that_slides_along_a_wall_is_counted_once(seed, rise):
    """Total = 1/2 l_p phi(nearest), over vertices, unequal elements and joints with stubs."""
    rng = np.random.default_rng(seed)
    of, p = polyline(rng, rise)
    touch = contact_of(of)
    half = 0.5 * touch.tributary[p] * touch.stiffness
    met = set()
    for s in np.linspace(0.5, 9.5, 120):
        x = of.rest.copy()
        x[2 * p : 2 * p + 2] = s, rise * s * (10.0 - s) + rng.uniform(0.2, 0.6)
        listed = only(near_pairs.find(x, touch, 2.0), p)
        nearest = least_distance(of, x, p)
        met.update(listed.edge.tolist())
        expected = half * T * barrier(nearest / T)[0]
        assert touch_of(touch, listed, x).energy(x) == pytest.approx(expected, rel=1e-9)
    assert len(met) > 7


def least_distance(of, x, p, elements=None):
    a, b = (x[: 2 * len(of.points)].reshape(-1, 2)[of.edges[:, side]] for side in (0, 1))
    u, w = b - a, x[2 * p : 2 * p + 2] - a
    tau = np.clip(np.sum(u * w, axis=1) / np.sum(u * u, axis=1), 0, 1)
    away = np.linalg.norm(w - tau[:, None] * u, axis=1)
    return away[~np.any(of.edges == p, axis=1) if elements is None else elements].min()
