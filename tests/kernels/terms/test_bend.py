"""Bending: derivatives, exact beams, joints, both elements and measures."""

import numpy as np
import pytest

from kernels.terms import bend
from tests.support.kernels.frames import (
    Frame,
    bend_of,
    frame,
    joint_of_four,
    scaled,
    shaken,
    walls_of,
)
from tests.support.kernels.terms import Term, bending_of, derivative_error, least_share

FRAME = joint_of_four()
MEASURES = [bend.ANGLE, bend.TANGENT]
ELEMENTS = ["cubic", "classical"]
HINGE = frame([(0, 0), (2.0, 0)], [(0, 1)], 2)


def term_of(of: Frame, measure: int = bend.ANGLE, element: str = "cubic") -> Term:
    return bending_of(walls_of(of), bend_of(of, measure, element == "cubic"))


def bent(turn: float, rotation: float = 0.0) -> np.ndarray:
    """Wall of two elements with its inner node turned, and both ends' rotations."""
    x = HINGE.rest.copy()
    x[2:4] = [1.0 + 1.2 * np.cos(turn), 1.2 * np.sin(turn)]
    x[6:9] = rotation, rotation, 0.5 * turn
    return x


def beam(rigidity: float, length: float) -> np.ndarray:
    """Stiffness of an Euler-Bernoulli beam against (v1, phi1, v2, phi2)."""
    s = length
    return rigidity / s**3 * np.array(
        [[12, 6 * s, -12, 6 * s], [6 * s, 4 * s * s, -6 * s, 2 * s * s],
         [-12, -6 * s, 12, -6 * s], [6 * s, 2 * s * s, -6 * s, 4 * s * s]]
    )  # fmt: skip


def condensed(of: Frame, element: str = "cubic") -> np.ndarray:
    """Stiffness of a wall along x against (v1, phi1, v2, phi2), its inner nodes free."""
    n = len(of.points)
    k = term_of(of, element=element).hessian(of.rest)
    ends = [1, 2 * n, 3, 2 * n + 1]
    inside = [c for i in range(2, n) for c in (2 * i + 1, 2 * n + i)]
    outer, mixed, inner = k[np.ix_(ends, ends)], k[np.ix_(inside, ends)], k[np.ix_(inside, inside)]
    return outer - mixed.T @ np.linalg.solve(inner, mixed) if inside else outer


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize(
    ("turn", "length"), [*((turn, 1.0) for turn in (0.0, 1e-6, -0.5, 1.5, 2.5, -2.9)), (1.5, 1e-3)]
)
def test_derivatives_of_a_bent_wall(turn, measure, length):
    of = scaled(HINGE, length)
    x = bent(turn, 0.3 * turn)
    x[:6] *= length
    assert derivative_error(term_of(of, measure), x, of.unit, 2e-4) < 1e-7


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize(("seed", "amount"), [(0, 0.0), (1, 0.3), (2, 0.3)])
def test_derivatives_at_rest_and_in_random_states(seed, amount, measure, element):
    x = shaken(FRAME, seed, amount)
    assert derivative_error(term_of(FRAME, measure, element), x, FRAME.unit, 2e-4) < 1e-7


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(2))
def test_projected_hessian_is_semi_definite(seed, measure, element):
    x = shaken(FRAME, seed, 0.5)
    term = term_of(FRAME, measure, element)
    assert np.linalg.eigvalsh(term.hessian(x))[0] < -1.0
    assert least_share(term, x, FRAME.unit) > -1e-12


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("pieces", [1, 2, 3, 8])
def test_a_straight_wall_of_cubics_is_exactly_a_beam(pieces, element):
    of = frame([(0, 0), (5.0, 0)], [(0, 1)], pieces)
    expected, found = beam(of.rigidity[0], 5.0), condensed(of, element)
    if element == "cubic":
        np.testing.assert_allclose(found, expected, rtol=1e-9)
    else:
        assert found[1, 1] < expected[1, 1] * (1 - 0.2 / pieces**2)


def test_a_classical_wall_has_discrete_hinges():
    """Eliminating phi of the node leaves Y I / h (turn of the hinge)^2 / 2; twice that at the
    clamped end.
    """
    x, k = bent(0.8), HINGE.rigidity[0]
    x[8] = 0.4
    for measure, turned in ((bend.ANGLE, 0.8), (bend.TANGENT, 2 * np.tan(0.4))):
        term = term_of(HINGE, measure, "classical")
        assert np.abs(term.gradient(x)[8]) < 1e-9 * k
        assert term.energy(x) == pytest.approx((0.5 + 1.0) * k * turned**2, rel=1e-12)


@pytest.mark.parametrize("turn", [0.5 * np.pi, 0.6 * np.pi, -2.0])
def test_half_a_hinge_that_turns_too_far_takes_infinite_energy(turn):
    """The tangent would come back from minus infinity beyond 90 degrees of half a hinge."""
    x = HINGE.rest.copy()
    x[8] = turn
    assert term_of(HINGE, bend.TANGENT, "classical").energy(x) == np.inf


@pytest.mark.parametrize("element", ELEMENTS)
def test_the_measures_agree_to_the_second_order(element):
    """C tan(d/c) = d + d^3/(3 c^2): energies differ in the fourth power of d."""
    apart = []
    for size in (0.02, 0.01):
        x = shaken(FRAME, 0, size)
        one, two = (term_of(FRAME, measure, element).energy(x) for measure in MEASURES)
        apart.append(two - one)
    assert apart[0] > 0
    assert np.log2(apart[0] / apart[1]) == pytest.approx(4.0, abs=0.06)


def test_eliminating_the_rotation_leaves_a_hinge_between_every_pair_of_arms():
    """K_ij = k_i k_j / sum k, for classical elements whose far ends turn with them."""
    of = frame([(0, 0), (2, 0), (0, 3), (-2, 1)], [(0, 1), (0, 2), (0, 3)], 1, [0.8, 0.5, 0.6])
    k = 2.0 * of.rigidity / of.l0
    x = shaken(of, 1)
    arms = x[:8].reshape(4, 2)[1:] - x[:2]
    turn = np.arctan2(*arms.T[::-1]) - np.arctan2(*of.direction.T[::-1])
    x[8], x[9:12] = k @ turn / k.sum(), turn
    pairs = 0.5 * np.outer(k, k) / k.sum() * 0.5 * (turn[:, None] - turn) ** 2
    assert term_of(of, element="classical").energy(x) == pytest.approx(pairs.sum(), rel=1e-12)
