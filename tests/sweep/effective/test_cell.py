"""The period of an infill: its size, its axes, its walls, and infills without one."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.faults import MisfitError
from sweep.design.geometry import Drawing
from sweep.design.infill import families
from sweep.effective.cell import frame_of, infill_of, turned
from sweep.effective.material import card
from sweep.effective.stiffness import response

BOX = {"width": 0.06, "height": 0.06, "depth": 0.01}


PRESS = {"mode": "displacement", "strain": 0.3}


def of(**lattice):
    return Case.of(lattice=BOX | lattice, loading=PRESS)


@pytest.mark.parametrize("kind", families())
def test_a_part_has_the_cells_of_the_endless_lattice_that_fills_it(kind):
    """Its period equals the period of the boundary "periodic" with the same cells."""
    part = infill_of(of(kind=kind, cells_x=4, cells_y=4))
    frame = frame_of(part)
    np.testing.assert_allclose(frame_of(infill_of(part.case)).period, frame.period, rtol=1e-12)
    whole = 4 / np.array([part.case.lattice.cells_x, part.case.lattice.cells_y]) * frame.period
    assert np.all(whole <= 0.06 * (1 + 1e-9))  # the rest are half cells at the sides
    assert np.all(whole > 0.75 * 0.06)
    total = frame.length @ frame.thickness / frame.area
    assert frame.filled == pytest.approx(total, rel=0.1)


def test_flat_and_pointy_hexagons_are_one_another_turned():
    sizes = ({"width": 0.04 * 3**0.5, "height": 0.06}, {"width": 0.06, "height": 0.04 * 3**0.5})
    pointy, flat = (
        card(of(kind="hex", orientation=way, cells_x=4, cells_y=4, boundary="periodic", **size))
        for way, size in zip(("pointy", "flat"), sizes, strict=True)
    )
    assert flat.modulus_1 == pytest.approx(pointy.modulus_2, rel=1e-6)
    assert flat.buckling == pytest.approx(pointy.buckling[::-1], rel=1e-6)


@pytest.mark.parametrize(("slicer", "pattern"), [("prusa", "grid"), ("orca", "tri-hexagon")])
def test_the_infill_of_a_slicer_has_its_share_and_its_angle(slicer, pattern):
    infill = infill_of(of(slicer=slicer, pattern=pattern, infill=0.2, fill_angle=0.3))
    frame = frame_of(infill)
    assert frame.length @ frame.thickness / frame.area == pytest.approx(0.2)
    assert infill.angle == 0.3


def test_a_lateral_lattice_is_one_of_diamonds():
    """With walls of s cos(45 deg), 2 s / r wide."""
    laid = of(slicer="orca", pattern="lateral-lattice", infill=0.2)
    width, wall = 10.0 * laid.lattice.line, laid.lattice.line * np.sqrt(0.5)
    box = {"width": 3 * width, "height": 3 * width, "cells_x": 3, "cells_y": 3}
    drawn = of(kind="diamond", wall_thickness=wall, **box)
    one, other = (frame_of(infill_of(case)) for case in (laid, drawn))
    assert infill_of(laid).angle == 0.0
    assert one.period == pytest.approx(other.period)
    assert one.filled == pytest.approx(other.filled)
    assert one.axial == pytest.approx(other.axial)


def test_honeycomb_bends_as_its_double_walls_do():
    """Walls 2 s, s, s thick in turn: the second moment is 1.41 times that of the mean wall."""
    case = of(slicer="prusa", pattern="honeycomb", infill=0.03, width=0.3, height=0.3)
    infill = infill_of(case.changed(solver={"joints": "points"}))
    double, even = (
        1.0 / np.linalg.inv(response(frame_of(one))[0])[0, 0]
        for one in (infill, infill._replace(gyration=1.0))
    )
    assert double / even == pytest.approx((10 / 3) / (4 / 3) ** 3, rel=5e-3)


def test_turning_a_stiffness_turns_its_axes():
    stiffness = np.diag([4.0, 1.0, 0.7])
    stiffness[0, 1] = stiffness[1, 0] = 0.3
    np.testing.assert_allclose(turned(stiffness, 0.0), stiffness)
    quarter = turned(stiffness, 0.5 * np.pi)
    np.testing.assert_allclose(np.diag(quarter), [1.0, 4.0, 0.7], atol=1e-12)
    back = turned(turned(stiffness, 0.4), -0.4)
    np.testing.assert_allclose(back, stiffness, atol=1e-12)
    isotropic = np.array([[1.0, 0.25, 0.0], [0.25, 1.0, 0.0], [0.0, 0.0, 0.375]])
    np.testing.assert_allclose(turned(isotropic, 0.7), isotropic, atol=1e-12)


PRUSA = {"slicer": "prusa", "pattern": "alignedrectilinear", "infill": 0.2}
ORCA = {"slicer": "orca", "pattern": "lateral-honeycomb", "infill": 0.2}
SQUARE = Drawing(((0.0, 0.0), (0.01, 0.0), (0.01, 0.01)), ((0, 1), (1, 2), (2, 0)))


@pytest.mark.parametrize(
    ("lattice", "why"),
    [
        ({"kind": "gyroid"}, "gyroid is a curved sheet: "),
        (BOX | {"grading": 1.5}, "square has walls that are graded, so that no period repeats"),
        (BOX | PRUSA, "alignedrectilinear has parallel lines, which only perimeters join"),
        (BOX | ORCA, "lateral-honeycomb has walls of two thicknesses"),
        ({"kind": "drawn", "drawing": SQUARE}, "a drawing, of which no period is known"),
    ],
)
def test_what_is_no_even_frame_is_refused(lattice, why):
    with pytest.raises(MisfitError, match=f"{why}.*allowed: cells of a family, or the infill of a"):
        infill_of(Case.of(lattice=lattice, loading=PRESS))


def test_walls_that_are_springs_are_refused():
    case = Case.of(lattice=BOX, material={"bend": "none"}, solver={"joints": "points"})
    with pytest.raises(MisfitError, match="walls that are springs"):
        infill_of(case)
