"""Friction in space: Coulomb's law, primal-dual Newton, no resultant, no slip of rigid motions."""

import numpy as np
import pytest

from kernels.geometry.space.vectors import SIZE
from kernels.laws.barrier import barrier
from kernels.plates.contacts import friction, touching
from kernels.terms.friction import DUAL_TOLERANCE, UNKNOWN, Friction
from tests.support.kernels.surfaces import (
    Sheet,
    contact_of,
    pairs_of,
    placed,
    positions,
    two_sheets,
    wavy,
)
from tests.support.kernels.terms import Term, derivative_error, differences, least_share

MU = 0.3
GAP = 0.4


def lagged(x, touch, mu=MU):
    """The contacts lagged at ``x``, without contact of edges, which has no friction."""
    listed = pairs_of(x, touch)
    found = friction.no_contacts(listed, touch, Friction(mu, 1.0))
    friction.lag(found, x, touch, listed, 0.0, Friction(mu, 1.0))
    return found


def two(seed=None):
    """Coordinates and contact of two sheets, one shaken if there is a ``seed``."""
    x, touch = two_sheets(GAP, Sheet(3, 3, 4, 4), Sheet(2, 2, 2, 2, (1.1, 0.8, 0)))
    if seed is not None:
        shake = np.random.default_rng(seed).uniform(-0.15, 0.15, positions(x).shape)
        x = placed(positions(x) + shake)
    return x, touch


def term_of(x0, contacts, slip) -> Term:
    """Friction of a step from x0."""

    def second(x):
        matrix, K = np.zeros((x.size, x.size)), np.zeros((12, 12))
        for k in range(contacts.count[0]):
            size = friction.block(x - x0, contacts, slip, k, K)
            at = (SIZE * contacts.nodes[k, :size, None] + np.arange(3)).ravel()
            np.add.at(matrix, np.ix_(at, at), K[: 3 * size, : 3 * size])
        return matrix

    return Term(lambda x, g: friction.evaluate(contacts, x - x0, slip, g), second)


def moved(x, move, nodes=slice(None)):
    y = x.copy()
    y[:-2].reshape(-1, SIZE)[nodes, :3] += move
    return y


@pytest.mark.parametrize("slip", [1e-2, 1.0])
@pytest.mark.parametrize("seed", range(3))
def test_derivatives(seed, slip):
    """Sticking and sliding, from a shaken state, which has contacts of sides and corners."""
    x0, touch = two(seed)
    contacts = lagged(x0, touch)
    assert contacts.count[0] > 10
    move = np.random.default_rng(seed).uniform(-0.1, 0.1, positions(x0).shape)
    x = moved(x0, move)
    term = term_of(x0, contacts, slip)
    assert derivative_error(term, x, 1.0, 1e-5) < 1e-6
    assert least_share(term, x) > -1e-13
    assert derivative_error(term, x0, 1.0, 1e-6 * slip) < 1e-3
    assert term.energy(x0) == pytest.approx(0.0, abs=1e-15 * slip)


@pytest.mark.parametrize("direction", [0.0, 0.7, 2.0, -1.3])
def test_sliding_sheets_are_held_by_mu_times_the_normal_force(direction):
    x0, touch = two_sheets(GAP, Sheet(3, 3, 2, 2), Sheet(2, 2, 2, 2))
    upper = slice(16, None)
    way = np.array([np.cos(direction), np.sin(direction), 0.0])
    g = term_of(x0, lagged(x0, touch), 1e-6).gradient(moved(x0, 0.3 * way, upper))
    held = g[:-2].reshape(-1, SIZE)[upper, :3].sum(axis=0)
    expected = MU * pressed_together(x0, touch)
    np.testing.assert_allclose(held, expected * way, rtol=1e-9, atol=1e-12)
    assert expected > MU * 3.9 * -barrier(GAP)[1]


def pressed_together(x, touch):
    """Sum of the normal forces of nodes and triangles, N: half is due to the upper nodes."""
    listed = pairs_of(x, touch)
    found = touching.no_contacts(touch, listed)
    touching.detect(x, touch, listed, 0.0, found)
    n = found.count[0]
    return -found.slope[:n][found.pair[:n] < 0].sum()


@pytest.mark.parametrize("seed", [1, 2, 7, 9])
def test_loads_add_up_to_the_normal_force_of_contact_at_each_node(seed):
    """Negative ones, of sides and corners in a hollow, are taken from the others."""
    x, touch = wavy(seed, gap=0.4)
    listed, contacts = pairs_of(x, touch), lagged(x, touch)
    found = touching.no_contacts(touch, listed)
    touching.detect(x, touch, listed, 0.0, found)
    of_nodes = found.pair[: found.count[0]] < 0
    forces = -found.slope[: found.count[0]][of_nodes]
    nodes, load = found.nodes[: found.count[0], 0][of_nodes], contacts.load[: contacts.count[0]]
    assert forces.min() < 0.0
    assert load.min() > 0.0
    n = len(touch.area)
    total = np.bincount(contacts.nodes[: load.size, 0], load, n)
    expected = MU * np.maximum(np.bincount(nodes, forces, n), 0.0)
    np.testing.assert_allclose(total, expected, atol=1e-12 * expected.max())


@pytest.mark.parametrize("seed", range(2))
def test_friction_opposes_every_move(seed):
    x, touch = wavy(seed, gap=0.4)
    term, rng = term_of(x, lagged(x, touch), 1e-3), np.random.default_rng(seed)
    for size in (1e-5, 1e-3, 1e-1):
        for _ in range(20):
            move = moved(x, size * rng.uniform(-1, 1, positions(x).shape)) - x
            assert move @ term.gradient(x + move) > 0.0


@pytest.mark.parametrize("seed", [None, 0, 1, 2])
def test_what_moves_as_one_does_not_slip(seed):
    x0, touch = two(seed)
    contacts = lagged(x0, touch)
    assert contacts.count[0] > 0
    for axis in np.eye(3):
        u = placed(np.cross(axis, positions(x0)) + 3.0, 0.0, 0.0)
        for k in range(contacts.count[0]):
            assert friction._slip(u, contacts, k) == pytest.approx((0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_friction_is_the_same_wherever_the_sheets_point(seed):
    x0, touch = two(seed)
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    x = moved(x0, rng.uniform(-0.1, 0.1, positions(x0).shape))
    turned0, turned = (placed(positions(y) @ turn.T) for y in (x0, x))
    expected = term_of(x0, lagged(x0, touch), 1e-2).energy(x)
    found = term_of(turned0, lagged(turned0, touch), 1e-2).energy(turned)
    assert found == pytest.approx(expected, rel=1e-9)


def test_platens_hold_in_both_directions():
    sheet = Sheet(2, 2, 3.0, 3.0)
    points = sheet.points[:, [0, 2, 1]]
    low = np.flatnonzero(points[:, 2] == 0.0)
    high = np.flatnonzero(points[:, 2] == 3.0)
    touch = contact_of(
        points, sheet.triangles, sheet.area, 0.8,
        low=(low, np.full(3, 0.08)), high=(high, np.full(3, 0.08)),
    )  # fmt: skip
    x0 = placed(points, -0.03, 3.05)
    contacts = lagged(x0, touch)
    assert contacts.count[0] == 6
    way = np.array([0.6, -0.8, 0.0])
    g = term_of(x0, contacts, 1e-5).gradient(moved(x0, 0.1 * way + [0, 0, 7.0]))
    for nodes, d in ((low, 0.03), (high, 0.05)):
        expected = -MU * 9.0 / 4.0 * barrier(d / 0.08)[1] * way
        np.testing.assert_allclose(
            g[:-2].reshape(-1, SIZE)[nodes, :3].sum(axis=0), expected, atol=1e-12
        )
    x = moved(x0, 0.3e-5 * way)
    assert derivative_error(term_of(x0, contacts, 1e-5), x, 1e-5, 1e-4) < 1e-6


@pytest.mark.parametrize("u", [(0.0, 0.0), (3e-4, -2e-4), (0.6, 0.5), (0.9, -0.9), (30.0, 40.0)])
def test_curvature_is_the_second_derivative_where_the_dual_fits(u):
    psi, _ = friction._psi(np.hypot(*u), 1.0)
    known = friction.curvature(u, (u[0] / psi, u[1] / psi), 1.0)
    assert known == pytest.approx(friction.curvature(u, (UNKNOWN, 0.0), 1.0))

    def slope(at):
        return np.array(at) / friction._psi(np.hypot(*at), 1.0)[0]

    step = np.full(2, 1e-5)
    matrix = differences(slope, np.array(u), step)
    (xx, xy), (_, yy) = matrix
    tolerance = 2e-5 if u == (0.0, 0.0) else 1e-8
    assert known == pytest.approx((xx, xy, yy), abs=tolerance)


def test_curvature_is_semi_definite_for_any_dual():
    rng = np.random.default_rng(0)
    for _ in range(300):
        u, w = rng.normal(size=2) * 10.0 ** rng.uniform(-3, 2), rng.normal(size=2)
        w /= max(np.linalg.norm(w), 1.0) * (1.0 if rng.uniform() < 0.5 else 2.0)
        xx, xy, yy = friction.curvature(tuple(u), tuple(w), 0.5)
        assert np.linalg.eigvalsh([[xx, xy], [xy, yy]])[0] > -1e-14


def held(slip):
    """One contact with the load 1, whose slip is the first two coordinates of node 0."""
    contacts = friction._room(1, None)
    contacts.nodes[:], contacts.size[:], contacts.slopes[:] = 0, 1, 0.0
    contacts.slopes[0, 0, 0, 0] = contacts.slopes[0, 0, 1, 1] = 1.0
    contacts.load[:], contacts.dual[:], contacts.count[:] = 1.0, UNKNOWN, 1
    return contacts


@pytest.mark.parametrize("start", [(3.0, 0.0), (0.02, -0.4), (-50.0, 20.0)])
@pytest.mark.parametrize(
    ("pull", "most"), [((0, 0), 15), ((0.6, -0.6), 15), ((3.0, 4.0), 15), ((0.6, 0.8), 40)]
)
def test_newton_finds_where_it_sticks_and_where_it_slides(pull, most, start):
    """The minimum of |u|^2 / 2 + |u| - pull . u, whose second derivative is a spike at 0."""
    slip, contacts, steps, K = 1e-4, held(1e-4), 0, np.zeros((12, 12))
    x = np.zeros(SIZE)
    x[:2] = start

    def force():
        g = np.zeros(SIZE)
        friction.evaluate(contacts, x, slip, g)
        return (x + g)[:2] - pull

    while np.linalg.norm(force()) > 1e-11 and steps <= most:
        friction.block(x, contacts, slip, 0, K)
        dx = np.zeros(SIZE)
        dx[:2] = np.linalg.solve(K[:2, :2] + np.eye(2), -force())
        x += dx
        fit = friction.follow(contacts, x, dx, 1.0, slip)
        steps += 1
    assert steps <= most
    assert fit
    psi, _ = friction._psi(np.hypot(*x[:2]), slip)
    assert np.linalg.norm(contacts.dual[0] - x[:2] / psi) < DUAL_TOLERANCE
    friction.forget(contacts)
    assert contacts.dual[0, 0] == UNKNOWN


def test_without_friction_there_is_no_room():
    x, touch = two()
    contacts = lagged(x, touch, 0.0)
    assert contacts.load.size == 0
    assert contacts.count[0] == 0


def test_edges_have_room_among_what_touches_though_none_is_lagged():
    x, touch = two(1)
    contacts, listed = lagged(x, touch), pairs_of(x, touch)
    more = listed._replace(one=np.tile(listed.one, 5))
    wider = friction.with_room(contacts, more, touch, Friction(MU, 1.0))
    size = more.triangle.size + more.lower.size + more.one.size
    assert len(wider.touching.nodes) == size > len(contacts.touching.nodes)
    assert wider.count[0] == contacts.count[0] > 0
    np.testing.assert_array_equal(wider.load, contacts.load)


def test_contacts_move_into_a_larger_room():
    x, touch = two(1)
    contacts = lagged(x, touch)
    listed = pairs_of(x, touch, 3.0)
    larger = friction.with_room(contacts, listed, touch, Friction(MU, 1.0))
    assert larger.load.size > contacts.load.size
    y = moved(x, 0.1)
    y[0] += 0.3
    terms = [term_of(x, c, 1e-2) for c in (contacts, larger)]
    np.testing.assert_array_equal(terms[0].gradient(y), terms[1].gradient(y))
    np.testing.assert_array_equal(terms[0].hessian(y), terms[1].hessian(y))
