"""Contact with rigid profiles: derivatives at degenerate points, friction, limits of a step."""

import numpy as np
import pytest

from kernels.geometry import near_pairs
from kernels.laws.barrier import barrier
from kernels.terms import friction, profile
from tests.support.kernels.frames import frame, scaled
from tests.support.kernels.profiles import SHAPES, below, resized
from tests.support.kernels.terms import (
    Term,
    derivative_error,
    differences,
    of_points,
)

T = 0.8  # walls act within 0.4
WALL = frame([(-2.0, 0.0), (2.0, 0.0)], [(0, 1)], 4)  # nodes at -2, 2, -1, 0, 1
ONE = frame([(-2.0, 0.0), (2.0, 0.0)], [(0, 1)], 1)


def term_of(of, shape) -> Term:
    """Contact of a frame with one profile."""
    touch = below(of, resized(shape, of.millimetre))
    args = touch.profiles, touch.stiffness
    return of_points(
        lambda x, g: profile.evaluate(x, *args, g),
        lambda x, matrix: profile.hessian(x, *args, matrix),
    )


def placed(of, along=0.0, gap=0.2, slope=0.0, bend=0.0):
    """The frame moved sideways and turned, with the tip of the profile at a ``gap`` above it.

    bend: of the wall, upwards at its ends.
    """
    x, n = of.rest.copy(), 2 * len(of.points)
    points = x[:n].reshape(-1, 2)
    points[:, 0] += along * of.millimetre
    points[:, 1] = slope * points[:, 0] + bend * points[:, 0] ** 2 / of.millimetre
    x[-1] = gap * of.millimetre
    return x


def lowered(x, touch, gap):
    """The profile moved down to a ``gap`` from the wall."""
    for _ in range(300):
        x[-1] += gap - profile.least_gap(x, touch.profiles)
    assert profile.least_gap(x, touch.profiles) == pytest.approx(gap)
    return x


@pytest.mark.parametrize(
    ("along", "length"),
    [*((along, 1.0) for along in (-0.01, 0.01, 0.3, 0.49, 1.51, 0.99)), (0.3, 1e-3)],
)
@pytest.mark.parametrize("shape", SHAPES)
def test_derivatives_of_a_straight_wall(shape, along, length):
    """Touching, at a corner, on a face, parallel, and with a tip at either side of a node."""
    of = scaled(WALL, length)
    for gap in (0.02, 0.2, 0.4 * 0.99, 0.4 * 1.01):
        x, step = placed(of, along, gap), min(2e-2 * min(gap, abs(0.4 - gap)), 5e-4)
        assert derivative_error(term_of(of, SHAPES[shape]), x, of.unit, step) < 1e-5, gap


@pytest.mark.parametrize(
    ("slope", "bend"), [(-0.4, -0.2), (0.02, 0.0), (0.02, 0.2), (1.0, 0.0), (1.0, 0.2)]
)
@pytest.mark.parametrize("shape", SHAPES)
def test_derivatives_of_leaning_and_bent_walls(shape, bend, slope):
    x = lowered(placed(WALL, 0.13, 9.0, slope, bend), below(WALL, SHAPES[shape]), 0.3)
    term = term_of(WALL, SHAPES[shape])
    assert term.energy(x) > 0.0
    assert derivative_error(term, x, WALL.unit, 1e-4) < 1e-5


@pytest.mark.parametrize("along", [-1.997, -1.203, 0.003, 1.997])
@pytest.mark.parametrize("shape", ["edge", "sharp", "thin", "cornered"])
def test_a_tip_between_two_nodes_is_pushed_back(shape, along):
    """A wall of one element: its nodes are far from a tip in its middle."""
    term, touch = term_of(ONE, SHAPES[shape]), below(ONE, SHAPES[shape])
    x = placed(ONE, along, 0.1)
    assert derivative_error(term, x, ONE.unit, 5e-4) < 1e-5
    assert term.gradient(x)[-1] < 0.0
    nearer = [term.energy(placed(ONE, along, gap)) for gap in (1e-3, 1e-6, 1e-9)]
    assert nearer == sorted(nearer)
    assert term.energy(placed(ONE, along, 0.0)) == np.inf
    assert profile.least_gap(x, touch.profiles) == pytest.approx(0.1)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("along", [-1.0, 0.0, 0.5])
def test_the_gradient_is_continuous(shape, along):
    term = term_of(WALL, SHAPES[shape])
    before, after = (
        term.gradient(placed(WALL, along + side, 0.15, 0.03)) for side in (-1e-9, 1e-9)
    )
    assert np.abs(before).max() > 0.0
    np.testing.assert_allclose(after, before, atol=1e-5 * np.abs(before).max())


@pytest.mark.parametrize("gap", [0.05, 0.2, 0.3])
def test_a_face_wider_than_the_wall_is_a_platen(gap):
    """Length x phi, and a force that a mesh does not change; so a circle of 10 km."""
    from sweep.design.profile import circle, punch

    for of in (WALL, ONE):
        for shape in (punch(0.0, 20.0, 0.5, 50.0), circle(0.0, 1e7)):
            term, x = term_of(of, shape), placed(of, 0.0, gap)
            each = of.modulus * of.depth * np.array(barrier(gap / 0.4)[:2]) * [0.4, 1.0]
            assert term.energy(x) == pytest.approx(4.0 * each[0], rel=1e-5)
            assert term.gradient(x)[-1] == pytest.approx(4.0 * each[1], rel=1e-5)


@pytest.mark.parametrize("shape", SHAPES)
def test_forces_of_wall_and_profile_are_in_balance(shape):
    term, x = term_of(WALL, SHAPES[shape]), placed(WALL, 0.3, 0.4, 0.1)
    g, n = term.gradient(x), 2 * len(WALL.points)
    assert g[1:n:2].sum() == pytest.approx(-g[-1], rel=1e-12)
    assert g[-2] == 0.0


def lagged(of, shape, x, mu=0.3):
    """Lagged contacts at ``x``."""
    touch, rubbing = below(of, shape), friction.Friction(mu, 1.0)
    contacts = friction.no_contacts(near_pairs.empty(), touch, rubbing)
    friction.lag(contacts, x, touch, near_pairs.empty(), 0.0, rubbing)
    return contacts


@pytest.mark.parametrize(("along", "slope"), [(0.0, 0.0), (0.3, 0.2), (0.99, -0.4)])
@pytest.mark.parametrize("shape", SHAPES)
def test_friction_of_a_profile(shape, along, slope):
    """Normal forces add up and none is negative; a common motion does no work; derivatives."""
    x = lowered(placed(WALL, along, 9.0, slope), below(WALL, SHAPES[shape]), 0.1)
    contacts = lagged(WALL, SHAPES[shape], x)
    count, n = contacts.count[0], 2 * len(WALL.points)
    assert count > 0
    assert contacts.load[:count].min() > 0.0
    if slope == 0.0 and SHAPES[shape].radius == 3.0:
        forces = -term_of(WALL, SHAPES[shape]).gradient(x)[-1]
        assert contacts.load[:count].sum() == pytest.approx(0.3 * forces, rel=0.1)
    lifted = np.zeros_like(x)
    lifted[1:n:2] = lifted[-1] = 0.7
    assert friction.evaluate(contacts, lifted, 0.01, np.zeros_like(x)) == pytest.approx(0.0)
    term = of_points(
        lambda y, g: friction.evaluate(contacts, y - x, 0.5, g),
        lambda y, matrix: friction.hessian(y - x, contacts, 0.5, matrix),
    )
    moved = x + np.random.default_rng(1).uniform(-0.05, 0.05, x.size)
    assert derivative_error(term, moved, WALL.unit, 1e-4) < 1e-6


def test_friction_acts_along_the_surface_of_a_profile():
    """The profile moves down along a leaning flank; friction acts upwards along the wall."""
    touch = below(WALL, SHAPES["edge"])
    x = lowered(placed(WALL, 0.0, 9.0, -2.0), touch, 0.1)
    contacts, g = lagged(WALL, SHAPES["edge"], x), np.zeros_like(x)
    down = np.zeros_like(x)
    down[-1] = -1.0
    friction.evaluate(contacts, down, 1e-3, g)
    n = 2 * len(WALL.points)
    assert g[-1] < 0.0  # the profile is held back
    assert g[1:n:2].sum() == pytest.approx(-g[-1])
    normals = differences(lambda y: profile.least_gap(y, touch.profiles), x, np.full(x.size, 1e-6))
    pull = np.array([g[0:n:2].sum(), g[1:n:2].sum()])
    across = np.array([normals[0:n:2].sum(), normals[1:n:2].sum()])
    assert abs(pull @ across) < 0.05 * np.linalg.norm(pull) * np.linalg.norm(across)


@pytest.mark.parametrize("shape", ["edge", "sharp", "thin", "punch"])
def test_a_step_stops_before_the_profile(shape):
    """Down by 5 mm at once on a wall 1 mm below, between its nodes: 0.9 of the gap."""
    x = placed(ONE, 0.37, 1.0)
    dx = np.zeros_like(x)
    dx[-1] = -5.0
    share = profile.step_limit(x, dx, below(ONE, SHAPES[shape]).profiles)
    assert share == pytest.approx(0.18, rel=2e-2)
    assert profile.step_limit(x, -dx, below(ONE, SHAPES[shape]).profiles) == 1.0


@pytest.mark.parametrize("shape", SHAPES)
def test_the_free_path_leads_to_the_surface_of_the_wall(shape):
    x, touch = placed(WALL, 0.3, 9.0, 0.3), below(WALL, SHAPES[shape])
    for _ in range(60):
        x[-1] -= profile.free_path(x, touch.profiles, x.size - 1, -1.0)
    assert profile.least_gap(x, touch.profiles) == pytest.approx(T / 2)
