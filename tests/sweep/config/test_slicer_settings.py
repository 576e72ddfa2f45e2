"""The settings of a slicer that print a design."""

from math import degrees, pi, radians

import pytest

from sweep.config.slicer_settings import slicer_settings
from sweep.design.slicer.patterns import line_of
from tests.support.designs.tables import lattice_with

LINE = line_of("prusa", 0.45e-3, 0.2e-3)
RISE = 0.75**0.5
# Boxes (mm) in which the cells of each drawing are regular, of walls of this length (mm).
REGULAR = {
    ("square", None): ((40.0, 30.0), (8, 6), 5.0),
    ("diamond", None): ((40.0, 30.0), (4, 3), 10.0 * 0.5**0.5),
    ("triangle", None): ((5.0 * 4, 5.0 * 4 * RISE), (4, 4), 5.0),
    ("kagome", None): ((5.0 * 6.0, 5.0 * 4 * RISE), (3, 2), 5.0),
    ("hex", "pointy"): ((3.0 * 9 * RISE, 3.0 * 6.5), (4, 4), 3.0),
    ("hex", "flat"): ((3.0 * 6.5, 3.0 * 9 * RISE), (4, 4), 3.0),
}
# Pattern, angle (degrees), share x wall / line, wall / line.
EXPECTED = {
    ("square", None): ("grid", 0.0, 2.0, 1.0),
    ("diamond", None): ("grid", 45.0, 2.0, 1.0),
    ("triangle", None): ("triangles", 0.0, 2.0 * 3.0**0.5, 1.0),
    ("kagome", None): ("stars", 0.0, 3.0**0.5, 1.0),
    ("hex", "pointy"): ("honeycomb", 30.0, 2.0 / 3.0**0.5, 4.0 / 3.0),
    ("hex", "flat"): ("honeycomb", 0.0, 2.0 / 3.0**0.5, 4.0 / 3.0),
}


def regular(kind, way, **changes):
    (width, height), (columns, rows), _ = REGULAR[kind, way]
    box = {"width": 1e-3 * width, "height": 1e-3 * height}
    cells = {"cells_x": columns, "cells_y": rows, "wall_thickness": EXPECTED[kind, way][3] * LINE}
    return lattice_with(kind=kind, orientation=way, **box | cells | changes)


def test_of_a_slicer_they_are_those_of_the_config():
    box = {"width": 20e-3, "height": 20e-3, "fill_angle": radians(30.0), "layer_height": 0.15e-3}
    lines = {"fill_multiline": 2, "perimeters": 3}
    settings = slicer_settings(
        lattice_with(slicer="orca", pattern="tri-hexagon", infill=0.25, **box, **lines)
    )
    assert (settings.slicer, settings.pattern, settings.infill, settings.perimeters) == (
        *("orca", "tri-hexagon", 0.25, 3),
    )
    assert settings.exact
    assert str(settings) == (
        "OrcaSlicer: tri-hexagon, 25 %, 2 lines a wall, line 0.45 mm, layer 0.15 mm, "
        "angle 30 degrees, 3 perimeters"
    )


@pytest.mark.parametrize(("kind", "way"), REGULAR)
def test_shares_are_those_of_the_slicer(kind, way):
    """A grid has 2 s / pitch; triangles of side a 2 sqrt(3) s / a; kagome of edge e sqrt(3) s / e;
    honeycomb of side a 2 s / (sqrt(3) a), with walls of 4 s / 3.
    """
    settings = slicer_settings(regular(kind, way))
    pattern, angle, share, _ = EXPECTED[kind, way]
    assert not settings.exact
    assert str(settings).startswith(f"PrusaSlicer, nearly: {pattern}, ")
    assert (settings.pattern, degrees(settings.fill_angle)) == (pattern, pytest.approx(angle))
    length = 1e-3 * REGULAR[kind, way][2]
    assert settings.infill == pytest.approx(share * LINE / length, rel=1e-6)
    assert settings.line_width == pytest.approx(0.45e-3)


def test_stretch_within_bounds_is_averaged():
    settings = slicer_settings(regular("square", None, width=41e-3))
    assert settings.infill == pytest.approx(2 * LINE / (5e-3 * 1.025**0.5), rel=1e-9)


def test_walls_round_a_grid_are_a_perimeter():
    plain, outlined = (regular("square", None, **more) for more in ({}, {"perimeters": 3}))
    assert slicer_settings(plain).perimeters == 1
    assert slicer_settings(plain).perimeter_width == pytest.approx(0.45e-3)
    assert slicer_settings(outlined).perimeters == 3
    mean = slicer_settings(outlined).perimeter_width - 0.2e-3 * (1.0 - pi / 4.0)
    assert mean == pytest.approx(0.4e-3)
    assert slicer_settings(regular("kagome", None)).perimeters == 0


def test_walls_are_lines_of_one_or_two_nozzles():
    least = line_of("prusa", 0.4e-3, 0.2e-3)
    for wall, printed in ((0.999 * least, False), (least, True), (0.8e-3, True), (0.801e-3, False)):
        assert (slicer_settings(regular("square", None, wall_thickness=wall)) is None) != printed
    fine = {"cells_x": 40, "cells_y": 30, "wall_thickness": 0.49e-3}
    assert slicer_settings(regular("square", None, **fine)).infill == pytest.approx(0.98)
