"""Kinds of solid joints: which are known by their openings, and what their arms yield."""

import numpy as np
import pytest

from sweep.scene.joint_kinds import AXIS, KINDS, find_joint, table


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


def test_the_table_has_all_angles():
    for kind in KINDS:
        parts = ("axis", "side") if kind in AXIS else ("all",)
        several = [table()[kind, part][0] for part in parts]
        for angles in several:
            np.testing.assert_array_equal(angles, several[0])
            assert np.all(np.diff(angles) > 0.0)
