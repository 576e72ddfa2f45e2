"""Friction: smoothed Coulomb law, limits of sticking and sliding, the normal force of contact."""

import numpy as np
import pytest

from kernels.geometry import near_pairs
from kernels.laws.barrier import barrier
from kernels.terms import contact, friction
from tests.support.kernels.frames import carried, only, scaled, shaken, touching, two_walls
from tests.support.kernels.terms import (
    Term,
    derivative_error,
    differences,
    least_share,
    of_points,
)

MU, T = 0.3, 0.8
WALLS = two_walls(0.5, (3, 2))
UPPER = np.unique(WALLS.edges[3:])


def lagged_of(of, x, mu=MU, node=None):
    touch = touching(of)
    listed = near_pairs.find(x, touch, 2.0 * touch.reach)
    if node is not None:
        listed = only(listed, node)
    return lagged(x, touch, listed, mu), touch, listed


def lagged(x, touch, listed, mu=MU):
    """The contacts lagged at ``x``."""
    rubbing = friction.Friction(mu, 1.0)
    contacts = friction.no_contacts(listed, touch, rubbing)
    friction.lag(contacts, x, touch, listed, np.inf, rubbing)
    n = contacts.count[0]
    return contacts._replace(
        points=contacts.points[:n], slopes=contacts.slopes[:n], load=contacts.load[:n],
        dual=contacts.dual[:n],
    )  # fmt: skip


def term_of(x0, contacts, slip) -> Term:
    """Friction of a step from x0."""
    return of_points(
        lambda x, g: friction.evaluate(contacts, x - x0, slip, g),
        lambda x, matrix: friction.hessian(x - x0, contacts, slip, matrix),
    )


def slid(amount):
    """Two walls after the upper one has moved by ``amount`` along both."""
    x = WALLS.rest.copy()
    x[2 * UPPER] += amount
    return x


def normal_force(gap, of=WALLS):
    return -of.modulus * of.depth * barrier(gap / T)[1]


@pytest.mark.parametrize("slip", [1.0, 1e-6])
@pytest.mark.parametrize("u", [0.0, 1e-3, -0.3, 0.999, -0.999, 1.001, -1.001, 7.0])
def test_smooth_size_and_its_derivatives(u, slip):
    value, slope = friction.smooth(u * slip, slip)
    curvature = friction.curvature(u * slip, friction.UNKNOWN, slip)
    at, step = np.array([u * slip]), np.array([1e-4 * slip])
    by_value = differences(lambda x: friction.smooth(x[0], slip)[0], at, step)[0]
    by_slope = differences(lambda x: friction.smooth(x[0], slip)[1], at, step)[0]
    assert by_value == pytest.approx(slope, abs=1e-9)
    assert by_slope == pytest.approx(curvature, abs=5e-4 / slip if u == 0.0 else 1e-8 / slip)
    assert friction.curvature(u * slip, slope, slip) == pytest.approx(curvature, abs=1e-12 / slip)
    assert value >= abs(u * slip) - 1e-15
    assert abs(slope) <= 1.0
    assert curvature >= 0.0


def test_smooth_size_joins_the_size_at_the_slip():
    inside, outside = friction.smooth(1.0 - 1e-12, 1.0), friction.smooth(1.0, 1.0)
    assert inside == pytest.approx(outside, abs=1e-11)
    assert outside == (1.0, 1.0)
    assert friction.curvature(1.0, friction.UNKNOWN, 1.0) == 0.0
    assert friction.smooth(0.0, 2.0) == pytest.approx((2 / 3, 0.0))
    assert friction.curvature(0.0, friction.UNKNOWN, 2.0) == 1.0


@pytest.mark.parametrize("start", [3.0, 0.02, -0.4, -50.0])
@pytest.mark.parametrize(("pull", "most"), [(0.0, 15), (0.9, 15), (-0.9, 15), (5.0, 15), (1.0, 30)])
def test_newton_finds_where_it_sticks_and_where_it_slides(pull, most, start):
    """The minimum of u^2 / 2 + |u| - pull u; with f'' alone Newton leaps to and fro for ever."""
    slip, steps, u = 1e-4, 0, np.array([start, 0.0])
    contacts = friction._room(1, near_pairs.empty(), 0)
    contacts.points[:], contacts.slopes[:] = 0, 0.0
    contacts.slopes[0, 0, 0] = 1.0
    contacts.load[:], contacts.dual[:], contacts.count[:] = 1.0, friction.UNKNOWN, 1

    def force():
        return u[0] + friction.smooth(u[0], slip)[1] - pull

    while abs(force()) > 1e-12 and steps <= most:
        move = -force() / (1.0 + friction.curvature(u[0], contacts.dual[0], slip))
        u[0] += move
        fit = friction.follow(contacts, u, np.array([move, 0.0]), 1.0, slip)
        steps += 1
        off = abs(contacts.dual[0] - friction.smooth(u[0], slip)[1])
        assert fit == (off < friction.DUAL_TOLERANCE)
    assert steps <= most
    assert fit


@pytest.mark.parametrize("length", [1.0, 1e-3])
@pytest.mark.parametrize("slip", [0.5, 5e-3])
@pytest.mark.parametrize("seed", range(2))
def test_derivatives_in_random_states(seed, slip, length):
    of = scaled(WALLS, length)
    x0 = shaken(of, seed, 0.1)
    contacts, _, _ = lagged_of(of, x0)
    assert len(contacts.load) > 5
    term, x = term_of(x0, contacts, slip * length), shaken(of, seed + 9, 0.1)
    assert derivative_error(term, x, of.unit, 1e-5) < 1e-6
    assert slip < 0.5 or least_share(term, x) > -1e-12  # all slides with the smaller one


@pytest.mark.parametrize("amount", [0.0, 0.002, -0.009, 0.011, 0.5])
def test_derivatives_while_sticking_and_sliding(amount):
    contacts, _, _ = lagged_of(WALLS, WALLS.rest)
    error = derivative_error(term_of(WALLS.rest, contacts, 0.01), slid(amount), WALLS.unit, 1e-6)
    assert error < (1e-3 if amount == 0.0 else 1e-6)  # |u|^3 has a kink in its third derivative


@pytest.mark.parametrize("bearing", [0.0, 0.7, -2.0])
def test_walls_that_turn_together_do_not_slip(bearing):
    x = carried(WALLS, WALLS.rest, bearing)
    turned, (moved, _, _) = carried(WALLS, x, 1e-6), lagged_of(WALLS, x)
    contacts, _, _ = lagged_of(WALLS, WALLS.rest)
    slides = term_of(WALLS.rest, contacts, 1e-3).energy(slid(1e-6))
    assert moved.load.sum() == pytest.approx(contacts.load.sum(), rel=1e-9)
    assert term_of(x, moved, 1e-3).energy(turned) < 1e-9 * slides


@pytest.mark.parametrize("pieces", [(1, 1), (3, 2), (12, 7), (24, 24)])
@pytest.mark.parametrize(("gap", "way"), [(0.2, 1.0), (0.6, -1.0)])
def test_sliding_walls_resist_with_mu_times_the_normal_force(gap, way, pieces):
    """Counted once with any mesh."""
    of = two_walls(gap, pieces)
    contacts, _, _ = lagged_of(of, of.rest)
    x, limit = of.rest.copy(), MU * 4.0 * normal_force(gap)
    upper = np.unique(of.edges[pieces[0] :])
    x[2 * upper] += 0.1 * way
    energy, g = term_of(of.rest, contacts, 1e-3).energy_gradient(x)
    assert g[2 * upper].sum() == pytest.approx(way * limit, rel=1e-11)
    forces = g[: 2 * len(of.points)].reshape(-1, 2)
    assert forces[:, 0].sum() == pytest.approx(0.0, abs=1e-9)
    moment = of.points[:, 0] @ forces[:, 1] - of.points[:, 1] @ forces[:, 0]
    assert abs(moment) < 1e-9 * limit
    assert energy == pytest.approx(limit * (0.1 - 1e-3 / 3), rel=1e-11)


def test_no_friction_or_no_contact_means_no_force():
    assert not np.any(lagged_of(WALLS, WALLS.rest, mu=0.0)[0].load)
    apart = two_walls(0.9, (3, 2))
    assert lagged_of(apart, apart.rest)[0].load.size == 0
    assert term_of(WALLS.rest, friction.none(), 1.0).energy(slid(0.1)) == 0.0


def normal_forces(x, touch, listed):
    """Forces of contact at ``x`` in N, and the node of each; subtracted ones are negative."""
    at = contact.no_contacts(listed)
    contact.detect(x, touch, listed, np.inf, at)
    forces = [contact.normal_force(touch, listed, at, i) for i in range(at.count[0])]
    return np.array(forces), listed.node[at.pair[: len(forces)]]


@pytest.mark.parametrize("pieces", [(12, 7), (24, 24), (5, 40)])
@pytest.mark.parametrize("seed", range(2))
def test_loads_add_up_to_the_normal_force_of_contact_at_each_node(seed, pieces):
    """Subtracted forces are taken from the others, and cancel in straight pairs."""
    of = two_walls(0.5, pieces)
    x = shaken(of, seed, 0.1)
    contacts, touch, listed = lagged_of(of, x)
    forces, nodes = normal_forces(x, touch, listed)
    assert forces.min() < 0.0
    assert contacts.load.min() > 0.0
    n = len(of.points)
    total = np.bincount(contacts.points[:, 0] // 2, contacts.load, n)
    expected = MU * np.maximum(np.bincount(nodes, forces, n), 0.0)
    np.testing.assert_allclose(total, expected, atol=1e-11 * expected.max())


@pytest.mark.parametrize("seed", range(2))
def test_the_order_in_which_pairs_are_listed_does_not_matter(seed):
    of, rng = two_walls(0.5, (24, 24)), np.random.default_rng(seed)
    x = shaken(of, seed, 0.3)
    contacts, touch, listed = lagged_of(of, x)
    order = rng.permutation(listed.node.size)
    other = lagged(x, touch, near_pairs.Pairs(*(column[order] for column in listed)))
    move = 0.1 * of.unit * rng.uniform(-1, 1, of.unit.size)
    one, two = (term_of(x, each, 1e-3).gradient(x + move) for each in (contacts, other))
    np.testing.assert_allclose(one, two, atol=1e-12 * np.abs(one).max())


@pytest.mark.parametrize("pieces", [(3, 2), (12, 7), (24, 24), (5, 40)])
def test_a_node_on_a_straight_wall_has_one_contact_with_it(pieces):
    contacts, _, _ = lagged_of(of := two_walls(0.5, pieces), of.rest)
    assert contacts.points[:, 0].size == np.unique(contacts.points[:, 0]).size


@pytest.mark.parametrize("seed", range(2))
def test_friction_opposes_every_move(seed):
    """However a step moves, friction takes energy up."""
    of = two_walls(0.5, (12, 7))
    x0 = shaken(of, seed, 0.1)
    contacts, _, _ = lagged_of(of, x0)
    term, rng = term_of(x0, contacts, 1e-3), np.random.default_rng(seed)
    for size in (1e-5, 1e-3, 1e-1):
        for _ in range(20):
            move = size * of.unit * rng.uniform(-1, 1, of.unit.size)
            assert move @ term.gradient(x0 + move) > 0.0


@pytest.mark.parametrize(("low", "high", "side"), [(-0.2, 30.0, 0), (-30.0, 0.75, 1)])
def test_a_wall_that_slides_on_a_platen(low, high, side):
    """Platens do not move sideways; they press with their whole force, not half of it."""
    x0 = WALLS.rest.copy()
    x0[-2:] = low, high
    touch = touching(WALLS)
    contacts = lagged(x0, touch, near_pairs.empty())
    assert lagged(x0, touch, near_pairs.empty(), 0.0).load.size == 0
    press = -4.0 * WALLS.modulus * WALLS.depth * barrier((0.2, 0.25)[side] / 0.4)[1]
    assert contacts.load.sum() == pytest.approx(MU * press, rel=1e-11)
    x = x0.copy()
    x[0 : 2 * len(WALLS.points)] += 0.5
    g = term_of(x0, contacts, 1e-3).gradient(x)
    assert g[0::2][: len(WALLS.points)].sum() == pytest.approx(MU * press, rel=1e-11)
    assert not g[1::2].any()
    assert derivative_error(term_of(x0, contacts, 2.0), x, WALLS.unit, 1e-4) < 1e-6
