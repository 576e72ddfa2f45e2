"""Bending: derivatives, exact beams, joints, both measures, rigid motions."""

from dataclasses import replace

import numpy as np
import pytest

from kernels import angle, bend, fold
from tests.frames import Frame, bend_of, carried, frame, joint_of_four, scaled, shaken
from tests.terms import derivative_error, gradient_of, hessian_of, least_share

FRAME = joint_of_four()
MEASURES = [bend.ANGLE, bend.TANGENT]
HINGE = frame([(0, 0), (2.0, 0)], [(0, 1)], 2)


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
    k = hessian_of(bend, (bend_of(of, exact=exact),), of.rest)
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
    assert derivative_error(bend, (bend_of(of, measure),), x, of.unit, 2e-4) < 1e-7


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(4))
def test_derivatives_in_random_states(seed, measure):
    x = shaken(FRAME, seed, 0.3)
    assert derivative_error(bend, (bend_of(FRAME, measure),), x, FRAME.unit, 2e-4) < 1e-7


def test_derivatives_at_rest():
    assert derivative_error(bend, (bend_of(FRAME),), FRAME.rest, FRAME.unit, 2e-4) < 1e-7


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(4))
def test_projected_hessian_is_semi_definite(seed, measure):
    x = shaken(FRAME, seed, 0.5)
    assert np.linalg.eigvalsh(hessian_of(bend, (bend_of(FRAME, measure),), x))[0] < -1.0
    assert least_share(bend, (bend_of(FRAME, measure),), x, FRAME.unit) > -1e-12


def test_a_joint_of_single_elements_is_semi_definite():
    """The coupling of a single element alone is indefinite: only the sum with its arms is not."""
    of = frame([(0, 0), (2, 0), (0, 2)], [(0, 1), (2, 0)], 1)
    x = shaken(of, 2, 0.6)
    assert least_share(bend, (bend_of(of),), x, of.unit) > -1e-12
    coupled = bend_of(of)
    alone = replace_stiffness(coupled, 0.0)
    assert least_share(bend, (alone,), x, of.unit) < -0.1


def replace_stiffness(of: bend.Bend, share: float) -> bend.Bend:
    """The same joints with a share of the stiffness of their arms."""
    return of._replace(arm_stiffness=share * of.arm_stiffness)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("turn", [0.3, np.pi / 2, 3.1, 3.2, -40.0])
def test_a_rigid_motion_changes_no_energy(turn, measure):
    """Any number of turns: arms are measured against the rotated joint and never wrap."""
    x = shaken(FRAME, 5)
    args = (bend_of(FRAME, measure),)
    assert bend.energy(x, *args) > 0.1
    moved = bend.energy(carried(FRAME, x, turn), *args)
    assert moved == pytest.approx(bend.energy(x, *args), rel=1e-11)


@pytest.mark.parametrize("turn", [0.3, 2.0, 50.0])
def test_the_rest_state_stays_free_of_energy_when_turned(turn):
    assert bend.energy(carried(FRAME, FRAME.rest, turn), bend_of(FRAME)) < 1e-20


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
        one, two = (bend.energy(x, bend_of(FRAME, measure)) for measure in MEASURES)
        apart.append(two - one)
    assert apart[0] > 0
    assert np.log2(apart[0] / apart[1]) == pytest.approx(4.0, abs=0.06)


def test_tangent_measure_of_one_hinge():
    stiffness = bend_of(HINGE).hinge_stiffness[0]
    args = (replace_stiffness(bend_of(HINGE, bend.TANGENT), 0.0),)
    expected = 0.5 * stiffness * (2 * np.tan(0.4)) ** 2
    assert bend.energy(bent(0.8), *args) == pytest.approx(expected, rel=1e-12)
    turned = replace_stiffness(bend_of(HINGE), 0.0)
    assert bend.energy(bent(0.8), turned) == pytest.approx(0.5 * stiffness * 0.64, rel=1e-12)


def test_eliminating_the_rotation_leaves_a_hinge_between_every_pair_of_arms():
    """K_ij = k_i k_j / sum k."""
    of = frame([(0, 0), (2, 0), (0, 3), (-2, 1)], [(0, 1), (0, 2), (0, 3)], 1, [0.8, 0.5, 0.6])
    joint = bend_of(of)
    at_centre = np.flatnonzero(joint.arms[:, 0] == 0)
    k, rest = joint.arm_stiffness[at_centre], joint.arm_rest[at_centre]
    only = joint._replace(
        arms=joint.arms[at_centre], arm_rest=rest, arm_stiffness=k,
        couplings=np.empty((0, 2), np.int64), coupling_stiffness=np.empty(0),
    )  # fmt: skip
    x = shaken(of, 1)
    arms = x[:8].reshape(4, 2)[1:] - x[:2]
    turn = np.arctan2(*arms.T[::-1]) - np.arctan2(*rest.T[::-1])
    x[8] = k @ turn / k.sum()
    pairs = 0.5 * np.outer(k, k) / k.sum() * 0.5 * (turn[:, None] - turn) ** 2
    assert bend.energy(x, only) == pytest.approx(pairs.sum(), rel=1e-12)


@pytest.mark.parametrize("psi", [0.1, 1.5, 3.1, -3.1, -1.0])
@pytest.mark.parametrize("rest", [0.0, 1.0, np.pi, -2.5])
def test_the_turn_is_the_angle_between_arms_less_that_at_rest(psi, rest):
    x = np.array([0.5 * np.cos(0.7), 0.5 * np.sin(0.7), 0, 0, np.cos(0.7 + psi), np.sin(0.7 + psi)])
    cross, dot = angle.between(x, 0, 1, 2)
    assert np.arctan2(cross, dot) == pytest.approx(psi)
    turned = angle.turned(cross, dot, np.cos(rest), np.sin(rest))
    assert turned == pytest.approx((psi - rest + np.pi) % (2 * np.pi) - np.pi)


def test_units_change_nothing():
    metre = scaled(FRAME, 1e-3)
    x = shaken(FRAME, 3)
    small = x.copy()
    small[: 2 * len(FRAME.points)] *= 1e-3
    in_mm = bend.energy(x, bend_of(FRAME))
    assert bend.energy(small, bend_of(metre)) == pytest.approx(1e-3 * in_mm, rel=1e-12)
    assert bend.energy(x, bend_of(replace(FRAME, modulus=24.0))) == pytest.approx(2 * in_mm)


LIMIT = np.radians(20.0)
FOLD = fold.Fold(np.array([[0, 1, 2]]), np.array([LIMIT]), np.array([3.0]))


def folded(opening: float, turn: float = 0.4, arms=(1.3, 0.8)) -> np.ndarray:
    """Two arms of node 1 that open anticlockwise by ``opening``."""
    one, two = arms[0] * np.exp(1j * turn), arms[1] * np.exp(1j * (turn + opening))
    return np.array([0.2 + one.real, one.imag, 0.2, 0, 0.2 + two.real, two.imag])


@pytest.mark.parametrize("length", [1.0, 1e-3, 1e3])
@pytest.mark.parametrize(
    "share", [1e-3, 0.02, 0.3, 0.9, 1 - 1e-3, 1 + 1e-3, 4.0, 4.6, 9.0, 9.01, 17.99]
)
def test_derivatives_of_a_fold(share, length):
    x, step = length * folded(share * LIMIT), min(1e-4, 1e-3 * share)
    assert derivative_error(fold, (FOLD,), x, length, step) < 1e-6


@pytest.mark.parametrize("share", [1e-6, 0.3, 0.99])
def test_energy_of_a_fold(share):
    expected = -3.0 * (share - 1) ** 2 * np.log(share)
    assert fold.energy(folded(share * LIMIT), FOLD) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    "opening", [LIMIT + 1e-9, 0.5, np.pi / 2, 2.0, np.pi, 4.0, 6.0, 2 * np.pi - 1e-9]
)
def test_a_fold_beyond_its_limit_costs_nothing(opening):
    x = folded(opening)
    assert fold.energy(x, FOLD) == 0.0
    assert np.all(gradient_of(fold, (FOLD,), x) == 0.0)


def test_closing_takes_infinite_energy():
    x = np.array([2.0, 0, 0, 0, 1.0, 0])
    assert fold.energy(x, FOLD) == np.inf
    energies = [fold.energy(folded(g), FOLD) for g in LIMIT * np.logspace(-1e-3, -12, 50)]
    assert np.all(np.diff(energies) > 0)


@pytest.mark.parametrize("share", [1e-3, 0.05, 0.5, 0.95])
def test_projected_fold_is_semi_definite(share):
    x = folded(share * LIMIT)
    assert least_share(fold, (FOLD,), x) > -1e-12
    assert np.linalg.eigvalsh(hessian_of(fold, (FOLD,), x))[0] < -1e-2


@pytest.mark.parametrize("turn", [1.0, 2.8, -2.0])
def test_a_fold_is_the_same_wherever_it_points(turn):
    before, after = (fold.energy(folded(0.3 * LIMIT, t), FOLD) for t in (0.4, turn))
    assert after == pytest.approx(before, rel=1e-10)
