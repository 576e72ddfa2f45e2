"""Contact: distances, barrier over the thickness, walls that count once, platens."""

import numpy as np
import pytest

from kernels.geometry import near_pairs
from kernels.laws.barrier import barrier
from kernels.terms import contact
from tests.support.kernels.frames import (
    grid,
    only,
    scaled,
    shaken,
    touching,
    two_walls,
)
from tests.support.kernels.terms import Term, derivative_error, least_share, touch_of

T = 0.8
ONE = two_walls(0.5, (1, 1))
WALLS = two_walls(0.5, (3, 2))


def phi(d, of=ONE, t=T):
    """Energy per length of two walls at distance ``d``."""
    return of.modulus * of.depth * t * barrier(d / t)[0]


def near(of, x, node=None):
    """Contact and its pairs at ``x``; with ``node``, the pairs of one node."""
    touch = touching(of)
    listed = near_pairs.find(x, touch, 3.0 * touch.reach)
    return touch, listed if node is None else only(listed, node)


def term_of(of, x, node=None) -> Term:
    """Contact of a frame with its pairs at ``x``, as in `near`."""
    return touch_of(*near(of, x, node), x)


def node_at(x, node, place):
    x = x.copy()
    x[2 * node : 2 * node + 2] = place
    return x


@pytest.mark.parametrize("gap", [0.01, 0.3, T * (1 - 1e-2), T * (1 + 1e-2)])
@pytest.mark.parametrize(
    ("along", "length"),
    [*((along, 1.0) for along in (-0.1, -0.002, 0.002, 1.7, 3.998, 4.002)), (1.7, 1e-3)],
)
def test_derivatives_of_one_pair(along, gap, length):
    of = scaled(ONE, length)
    x = length * node_at(ONE.rest, 2, (along, gap))
    assert len(near(of, x, 2)[1].node) == 1
    step = 1e-3 * min(gap, abs(T - gap), 1.0)
    assert derivative_error(term_of(of, x, 2), x, of.unit, min(step, 5e-4)) < 1e-6


@pytest.mark.parametrize("along", [4 / 3 - 0.002, 4 / 3 + 0.002, 1.1])
@pytest.mark.parametrize("bend", [-0.3, 0.0, 0.3])
def test_derivatives_beside_a_vertex(along, bend):
    """Vertices are taken off: straight, on the inner and on the outer side of a bent wall."""
    x = node_at(node_at(WALLS.rest, 4, (4 / 3, bend)), 2, (along, 0.5 + bend))
    touch, listed = near(WALLS, x, 2)
    assert any(1.0 in near_pairs.counted(listed, k, touch)[1:] for k in range(len(listed.node)))
    assert derivative_error(term_of(WALLS, x, 2), x, WALLS.unit, 2e-4) < 1e-6


@pytest.mark.parametrize("seed", range(4))
def test_derivatives_of_two_walls_in_random_states(seed):
    x = shaken(WALLS, seed, 0.1)
    term = term_of(WALLS, x)
    assert term.energy(x) > 1.0
    assert derivative_error(term, x, WALLS.unit, 1e-4) < 1e-6


@pytest.mark.parametrize("along", [0.0, 4 / 3, 8 / 3, 4.0])
def test_the_gradient_is_continuous_over_a_vertex(along):
    before, after = (node_at(WALLS.rest, 2, (along + side, 0.4)) for side in (-1e-9, 1e-9))
    term = term_of(WALLS, before)
    slopes = [term.gradient(x) for x in (before, after)]
    assert np.abs(slopes[0]).max() > 10
    np.testing.assert_allclose(slopes[1], slopes[0], atol=1e-5)


@pytest.mark.parametrize("gap", [0.1, 0.75])
@pytest.mark.parametrize("pieces", [(n, m) for n in (1, 3, 12, 48) for m in (n, n + 1, 5)])
def test_parallel_walls_count_once_at_any_mesh(pieces, gap):
    """Aligned and staggered nodes: length x phi to round-off, and half of it from each side."""
    of = two_walls(gap, pieces)
    term = term_of(of, of.rest)
    assert term.energy(of.rest) == pytest.approx(4.0 * phi(gap), rel=1e-12)
    assert contact.least_gap(of.rest, *near(of, of.rest), 0.0) == pytest.approx(gap)
    upper = 2 * np.unique(of.edges[pieces[0] :]) + 1
    expected = 4.0 * of.modulus * of.depth * barrier(gap / T)[1]
    assert term.gradient(of.rest)[upper].sum() == pytest.approx(expected, rel=1e-12)


def test_tilted_walls_converge_with_the_square_of_the_element():
    energies = []
    for pieces in (6, 12, 24, 48):
        of = two_walls(0.2, (pieces, pieces), slope=0.1)
        energies.append(term_of(of, of.rest).energy(of.rest))
    change = -np.diff(energies) / energies[3]
    assert 0 < change[0] < 0.02
    np.testing.assert_allclose(np.log2(change[:-1] / change[1:]), 2.0, atol=0.15)


@pytest.mark.parametrize("gap", [0.0, 1e-12])
@pytest.mark.parametrize("along", [0.0, 4 / 3, 0.5, 4.0])
def test_touching_centre_lines_take_infinite_energy(along, gap):
    """The energy is infinite at a vertex too, where the subtracted energy is infinite as well, and
    within the round-off of positions.
    """
    of = two_walls(0.5, (3, 1))
    x = node_at(node_at(of.rest, 4, (4 / 3, 0.0)), 2, (along, gap))
    assert term_of(of, x).energy(x) == np.inf


def between_platens(low, high):
    x = ONE.rest.copy()
    x[-2:] = low, high
    return x


@pytest.mark.parametrize("length", [1.0, 1e-3])
@pytest.mark.parametrize(("low", "high"), [(-0.1, 30), (-0.395, 30), (-0.405, 0.89), (-0.01, 0.51)])
def test_derivatives_of_platens(low, high, length):
    """A platen touches at half a thickness; both, one and none of the walls' sides are near."""
    of = scaled(ONE, length)
    x = length * between_platens(low, high)
    assert derivative_error(plates(of), x, of.unit, 1e-4 if low < -0.05 else 1e-5) < 1e-6
    assert least_share(plates(of), x) > -1e-12


def plates(of):
    return touch_of(touching(of), near_pairs.empty(), of.rest)


def test_a_wall_on_a_platen_has_its_length_times_phi_at_half_the_thickness():
    x = between_platens(-0.15, 30.0)
    term = plates(ONE)
    assert term.energy(x) == pytest.approx(4.0 * phi(0.15, t=0.4), rel=1e-12)
    slope = term.gradient(x)
    assert slope[-2] == pytest.approx(-slope[1:8:2].sum())
    assert slope[-2] > 1
    assert term.energy(between_platens(0.0, 30.0)) == np.inf
    assert term.energy(between_platens(0.1, 30.0)) == np.inf
    assert term.energy(between_platens(-0.4, 0.9)) == 0.0


GRID = grid(2, 8.0, 4)


def wandered(rng, amount):
    """Move of all nodes in random directions by up to ``amount``; platens stay."""
    move, n = np.zeros_like(GRID.rest), len(GRID.points)
    bearing, size = rng.uniform(-np.pi, np.pi, n), amount * rng.uniform(0.0, 1.0, n) ** 0.2
    move[: 2 * n] = np.column_stack([size * np.cos(bearing), size * np.sin(bearing)]).ravel()
    return move


def crumpled(rng, touch):
    """A state in which some walls are near one another, and all its pairs."""
    x = GRID.rest + wandered(rng, 0.9)
    x[-2:] = -2.0, 10.0
    listed = near_pairs.find(x, touch, 20.0)
    assert np.all(np.diff(listed.distance) >= 0.0)
    return x, listed


@pytest.mark.parametrize("drift", [0.0, 0.01, 0.2])
@pytest.mark.parametrize("most", [1e-3, 0.1, 0.4, 1.0, 4.0])
def test_the_bound_of_a_step_misses_no_contact(most, drift):
    """Pairs that are too far away to meet are skipped: the first hit is the first of all pairs."""
    rng, touch, hits = np.random.default_rng(8), touching(GRID), 0
    for _ in range(40):
        anchor, listed = crumpled(rng, touch)
        x, dx = anchor + wandered(rng, drift), wandered(rng, most)
        first = contact.step_limit(x, dx, np.inf, touch, listed, 0.0)
        found = contact.step_limit(x, dx, most, touch, listed, drift)
        assert found == first or min(found, first) > 1.0
        hits += first <= 1.0
    assert hits > 20 or most < 0.2


@pytest.mark.parametrize("drift", [0.0, 0.01, 0.2, 0.6])
def test_what_drifts_into_contact_is_seen(drift):
    """A list is read as far as contact may reach, with the same result as reading all of it."""
    rng, touch, touched = np.random.default_rng(3), touching(GRID), 0
    for _ in range(40):
        anchor, listed = crumpled(rng, touch)
        x = anchor + wandered(rng, drift)
        found, full = np.zeros((2, x.size))
        some, every = contact.no_contacts(listed), contact.no_contacts(listed)
        energy = contact.evaluate(x, touch, listed, drift, some, found)
        assert energy == contact.evaluate(x, touch, listed, np.inf, every, full)
        for part, whole in zip(some[:-1], every[:-1], strict=True):
            np.testing.assert_array_equal(part[: some.count[0]], whole[: every.count[0]])
        np.testing.assert_array_equal(found, full)
        touched += some.count[0]
    assert touched > 100
