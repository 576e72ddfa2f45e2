"""Kinds of solid joints: which are known by their openings, and the compliance of their arms."""

import numpy as np
import pytest

from sweep.scene.joint_kinds import AXIS, KINDS, find_joint, flexibility, table, unequal


def found(*openings, in_row=(), arm=0):
    opened = np.array(openings, float)
    row = np.isin(np.arange(len(opened)), in_row)
    joint = find_joint(opened, row)
    return joint and joint.compliance[arm]


@pytest.mark.parametrize(
    ("openings", "mm"),
    [
        ((90, 90, 90, 90), -1.541),
        ((270, 90), -1.441),
        ((60, 120, 60, 120), -4.201),
        ((60,) * 6, -5.281),
        ((72, 288), -3.048 + 0.4 * (3.048 - 2.533)),
    ],
)
def test_a_joint_is_known_by_its_openings(openings, mm):
    """In any order and either way round; between two angles by interpolation."""
    for turned in range(len(openings)):
        one = np.roll(openings, turned)
        for way in (one, one[::-1]):
            assert found(*way)[0, 0] == pytest.approx(mm, abs=2e-3)


@pytest.mark.parametrize(
    ("openings", "axis", "mm"),
    [
        ((90, 180, 90), 0, (-1.919, -1.427)),
        ((180, 120, 60), 2, (-4.214, -1.901)),
        ((110, 125, 125), 2, (-0.523, -0.836)),
        ((55, 250, 55), 0, (-5.955, -5.549)),
    ],
)
def test_an_arm_along_the_axis_differs_from_the_others(openings, axis, mm):
    """Arm i is before opening i; that holds wherever the count of the openings begins."""
    for turned in range(3):
        one = np.roll(openings, turned)
        for arm in range(3):
            expected = mm[0] if arm == (axis + turned) % 3 else mm[1]
            assert found(*one, arm=arm)[0, 0] == pytest.approx(expected, abs=2e-3)


def test_other_joints_are_not_known():
    for openings in ((70, 150, 140), (8, 172, 8, 172), (72,) * 5, (45,) * 8):
        assert found(*openings) is None


def test_an_arm_on_a_glued_row_differs():
    """If it stands upright on the row; an oblique one is as any other."""
    inner, corner = found(90, 90, 180, in_row=(0, 2)), found(90, 270, in_row=(0,))
    assert (inner[0, 0], corner[0, 0]) == (-1.57, 0.303)
    oblique, free = found(60, 120, 180, in_row=(0, 2), arm=1), found(60, 120, 180, arm=1)
    np.testing.assert_array_equal(oblique, free)


def test_arms_of_equal_thickness_are_as_in_the_table():
    opened = np.array([70.0, 110.0, 70.0, 110.0])
    joint = find_joint(opened, np.zeros(4, np.bool_))
    same = unequal(joint, opened, np.full(4, 2e-3))
    np.testing.assert_array_equal(same.compliance, joint.compliance)
    np.testing.assert_array_equal(same.length, joint.length)


def test_an_arm_beside_a_thick_one_is_the_same_joint_farther_out():
    """F of both, as a rigid piece of length d precedes the joint of equal arms."""
    opened, nu = np.full(4, 90.0), 0.4
    joint = find_joint(opened, np.zeros(4, np.bool_))
    moved = unequal(joint, opened, np.array([1.0, 1.5, 1.0, 1.5]))
    d = 0.25
    assert moved.length[0] == pytest.approx(joint.length[0] + d)
    turned = np.array([[1.0, 0.0], [-d, 1.0]])  # V and M - V d
    before, after = (flexibility(part.compliance, part.length, nu)[0] for part in (joint, moved))
    np.testing.assert_allclose(after, turned.T @ before @ turned, rtol=1e-12)
    assert moved.compliance[0, 3, 0] == pytest.approx(joint.compliance[0, 3, 0] - 0.5 * d)
    np.testing.assert_allclose(moved.compliance[1], joint.compliance[1] / 1.5)


@pytest.mark.parametrize("nu", [0.0, 0.48, 0.923])
@pytest.mark.parametrize("kind", KINDS)
def test_joints_of_unequal_arms_are_stable(kind, nu):
    rng = np.random.default_rng(2)
    angles = table()[kind, "side" if kind in AXIS else "all"][0]
    for angle in np.linspace(angles[0], angles[-1], 20):
        opened = np.array(KINDS[kind](angle))
        joint = find_joint(opened, np.zeros(len(opened), np.bool_))
        found = unequal(joint, opened, rng.uniform(1.0, 4.0, len(opened)))
        assert np.linalg.eigvalsh(flexibility(*found, nu)).min() > 0.0
        assert np.all(found.compliance[:, 3] @ nu ** np.arange(3) + found.length > 0.0)
