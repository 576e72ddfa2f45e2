"""Bending: derivatives, exact beams, joints, both measures, rigid motions."""

from dataclasses import replace

import numpy as np
import pytest

from kernels.terms import bend
from tests.support.frames import (
    Frame,
    bend_of,
    carried,
    frame,
    joint_of_four,
    scaled,
    shaken,
    walls_of,
)
from tests.support.terms import Term, bending_of, derivative_error, least_share

FRAME = joint_of_four()
MEASURES = [bend.ANGLE, bend.TANGENT]
HINGE = frame([(0, 0), (2.0, 0)], [(0, 1)], 2)


def term_of(of: Frame, bending: bend.Bend | None = None, x0=None) -> Term:
    """Bending of a frame, by default as `bend_of`; turns count from x0 (or x)."""
    return bending_of(walls_of(of), bend_of(of) if bending is None else bending, x0)


def bent(turn: float, rotation: float = 0.0) -> np.ndarray:
    """Wall of two elements with its hinge turned, and both ends' rotations."""
    x = HINGE.rest.copy()
    x[2:4] = [1.0 + 1.2 * np.cos(turn), 1.2 * np.sin(turn)]
    x[6:8] = rotation
    return x


def beam(rigidity: float, length: float) -> np.ndarray:
    """Stiffness of an Euler-Bernoulli beam against (v1, phi1, v2, phi2)."""
    s = length
    return rigidity / s**3 * np.array(
        [[12, 6 * s, -12, 6 * s], [6 * s, 4 * s * s, -6 * s, 2 * s * s],
         [-12, -6 * s, 12, -6 * s], [6 * s, 2 * s * s, -6 * s, 4 * s * s]]
    )  # fmt: skip


def condensed(of: Frame, exact: bool = True) -> np.ndarray:
    """Stiffness of a wall along x against (v1, phi1, v2, phi2), its inner nodes free."""
    n = len(of.points)
    k = term_of(of, bend_of(of, exact=exact)).hessian(of.rest)
    ends, inside = [1, 2 * n, 3, 2 * n + 1], [2 * i + 1 for i in range(2, n)]
    outer, mixed, inner = k[np.ix_(ends, ends)], k[np.ix_(inside, ends)], k[np.ix_(inside, inside)]
    return outer - mixed.T @ np.linalg.solve(inner, mixed) if inside else outer


@pytest.mark.parametrize("length", [1.0, 1e-3, 1e3])
@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("turn", [0.0, 1e-6, -0.5, 1.5, 2.5, -2.9])
def test_derivatives_of_a_bent_wall(turn, measure, length):
    of = scaled(HINGE, length)
    x = bent(turn, 0.3 * turn)
    x[:6] *= length
    assert derivative_error(term_of(of, bend_of(of, measure)), x, of.unit, 2e-4) < 1e-7


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(4))
def test_derivatives_in_random_states(seed, measure):
    x = shaken(FRAME, seed, 0.3)
    assert derivative_error(term_of(FRAME, bend_of(FRAME, measure)), x, FRAME.unit, 2e-4) < 1e-7


def test_derivatives_at_rest():
    assert derivative_error(term_of(FRAME), FRAME.rest, FRAME.unit, 2e-4) < 1e-7


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(4))
def test_projected_hessian_is_semi_definite(seed, measure):
    x = shaken(FRAME, seed, 0.5)
    term = term_of(FRAME, bend_of(FRAME, measure))
    assert np.linalg.eigvalsh(term.hessian(x))[0] < -1.0
    assert least_share(term, x, FRAME.unit) > -1e-12


def test_a_joint_of_single_elements_is_semi_definite():
    """The coupling of a single element alone is indefinite: only the sum with its arms is not."""
    of = frame([(0, 0), (2, 0), (0, 2)], [(0, 1), (2, 0)], 1)
    x = shaken(of, 2, 0.6)
    assert least_share(term_of(of), x, of.unit) > -1e-12
    alone = with_arms(bend_of(of), 0.0)
    assert least_share(term_of(of, alone), x, of.unit) < -0.1


def with_arms(of: bend.Bend, share: float) -> bend.Bend:
    """The same joints with a share of the stiffness of their arms."""
    return of._replace(arm_stiffness=share * of.arm_stiffness)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("turn", [0.3, np.pi / 2, 3.1, 3.2, -40.0])
def test_a_rigid_motion_changes_no_energy(turn, measure):
    """Any number of turns: arms are measured against the rotated joint and never wrap."""
    x, bending = shaken(FRAME, 5), bend_of(FRAME, measure)
    term = term_of(FRAME, bending)
    assert term.energy(x) > 0.1
    moved = carried(FRAME, x, turn)
    assert term.energy(moved) == pytest.approx(term.energy(x), rel=1e-11)
    within = term_of(FRAME, bending, carried(FRAME, x, turn - 2.0))
    assert within.energy(moved) == pytest.approx(term.energy(x), rel=1e-11)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("turn", [-1.9, 0.0, 1.0, 1.9])
def test_turns_do_not_depend_on_where_they_are_counted_from(turn, measure):
    x, bending = shaken(FRAME, 6, 0.3), bend_of(FRAME, measure)
    here, there = (
        term_of(FRAME, bending, x0) for x0 in (x, carried(FRAME, shaken(FRAME, 7, 0.3), turn))
    )
    assert there.energy(x) == pytest.approx(here.energy(x), rel=1e-11)
    np.testing.assert_allclose(there.gradient(x), here.gradient(x), rtol=0, atol=1e-9)
    np.testing.assert_allclose(there.hessian(x), here.hessian(x), rtol=0, atol=1e-9)


@pytest.mark.parametrize("turn", [0.3, 2.0, 50.0])
def test_the_rest_state_stays_free_of_energy_when_turned(turn):
    assert term_of(FRAME).energy(carried(FRAME, FRAME.rest, turn)) < 1e-20


@pytest.mark.parametrize("pieces", range(1, 9))
def test_a_straight_wall_is_exactly_a_beam(pieces):
    of = frame([(0, 0), (5.0, 0)], [(0, 1)], pieces)
    expected = beam(of.rigidity[0], 5.0)
    np.testing.assert_allclose(condensed(of), expected, rtol=1e-10)
    if pieces > 1:
        assert condensed(of, exact=False)[1, 1] < expected[1, 1] * (1 - 0.2 / pieces**2)


def test_a_slender_end_rotation_meets_4_and_2_rigidities_over_length():
    of = frame([(0, 0), (5.0, 0)], [(0, 1)], 3)
    k, unit = condensed(of), of.rigidity[0] / 5.0
    assert (k[1, 1], k[1, 3]) == pytest.approx((4 * unit, 2 * unit), rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_the_measures_agree_to_the_second_order(seed):
    """2 tan(d/2) = d + d^3/12: energies of 1/2 K d^2 differ in the fourth power of d."""
    move = shaken(FRAME, seed) - FRAME.rest
    apart = []
    for size in (0.1, 0.05):
        x = FRAME.rest + size * move
        one, two = (term_of(FRAME, bend_of(FRAME, measure)).energy(x) for measure in MEASURES)
        apart.append(two - one)
    assert apart[0] > 0
    assert np.log2(apart[0] / apart[1]) == pytest.approx(4.0, abs=0.06)


def test_tangent_measure_of_one_hinge():
    stiffness = bend_of(HINGE).hinge_stiffness[0]
    angle, tangent = (
        term_of(HINGE, with_arms(bend_of(HINGE, measure), 0.0)) for measure in MEASURES
    )
    expected = 0.5 * stiffness * (2 * np.tan(0.4)) ** 2
    assert tangent.energy(bent(0.8)) == pytest.approx(expected, rel=1e-12)
    assert angle.energy(bent(0.8)) == pytest.approx(0.5 * stiffness * 0.64, rel=1e-12)


def test_eliminating_the_rotation_leaves_a_hinge_between_every_pair_of_arms():
    """K_ij = k_i k_j / sum k."""
    of = frame([(0, 0), (2, 0), (0, 3), (-2, 1)], [(0, 1), (0, 2), (0, 3)], 1, [0.8, 0.5, 0.6])
    at_centre = of.arm_joint == 0
    joint = bend_of(of)
    k, rest = joint.arm_stiffness[at_centre], joint.arm_rest[at_centre]
    only = joint._replace(
        arm_stiffness=np.where(at_centre, joint.arm_stiffness, 0.0), coupling=np.zeros(3)
    )
    x = shaken(of, 1)
    arms = x[:8].reshape(4, 2)[1:] - x[:2]
    turn = np.arctan2(*arms.T[::-1]) - np.arctan2(*rest.T[::-1])
    x[8] = k @ turn / k.sum()
    pairs = 0.5 * np.outer(k, k) / k.sum() * 0.5 * (turn[:, None] - turn) ** 2
    assert term_of(of, only).energy(x) == pytest.approx(pairs.sum(), rel=1e-12)


@pytest.mark.parametrize("psi", [0.1, 1.5, 3.1, -3.1, -1.0])
@pytest.mark.parametrize("rest", [0.0, 1.0, np.pi, -2.5])
def test_between_is_the_angle_from_one_direction_to_another(psi, rest):
    one, two = (rest, rest + psi)
    found = bend.between(np.cos(one), np.sin(one), np.cos(two), np.sin(two))
    assert found == pytest.approx(psi, abs=1e-12)


def test_units_change_nothing():
    metre = scaled(FRAME, 1e-3)
    x = shaken(FRAME, 3)
    small = x.copy()
    small[: 2 * len(FRAME.points)] *= 1e-3
    in_mm = term_of(FRAME).energy(x)
    assert term_of(metre).energy(small) == pytest.approx(1e-3 * in_mm, rel=1e-12)
    assert term_of(replace(FRAME, modulus=24.0)).energy(x) == pytest.approx(2 * in_mm)
