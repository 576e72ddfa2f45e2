"""The settings of a slicer that print a design."""

from math import degrees, radians

import pytest

from sweep.config.case import Case
from sweep.config.defaults.slicer_settings import slicer_settings
from sweep.design.slicer.patterns import line_of

LINE = line_of("prusa", 0.45e-3, 0.2e-3)
BOX = {"width": 20e-3, "height": 20e-3}


def settings(**lattice):
    return slicer_settings(Case.of(lattice=lattice))


def test_of_a_slicer_they_are_those_of_the_config():
    given = {"slicer": "orca", "pattern": "tri-hexagon", "infill": 0.25, "perimeters": 3}
    found = settings(**given, fill_angle=radians(30.0), layer_height=0.15e-3, **BOX)
    assert (found.slicer, found.pattern, found.infill, found.perimeters, found.exact) == (
        *("orca", "tri-hexagon", 0.25, 3),
        True,
    )
    assert str(found) == (
        "OrcaSlicer: tri-hexagon, 25 %, line 0.45 mm, layer 0.15 mm, angle 30 degrees, 3 perimeters"
    )


@pytest.mark.parametrize(
    ("lattice", "pattern", "infill", "angle"),
    [
        ({"kind": "square"}, "grid", 2 * LINE / 5e-3, 0.0),
        ({"kind": "diamond"}, "grid", 2 * LINE / (5e-3 * 0.5**0.5), 45.0),
    ],
)
def test_regular_grids_correspond_to_the_slicers(lattice, pattern, infill, angle):
    found = settings(**lattice, **BOX, cells_x=4, cells_y=4, wall_thickness=LINE)
    assert not found.exact
    assert (found.pattern, found.infill) == (pattern, pytest.approx(infill))
    assert found.line_width == pytest.approx(0.45e-3)
    assert degrees(found.fill_angle) == pytest.approx(angle)
    assert str(found).startswith("PrusaSlicer, nearly: grid, ")


@pytest.mark.parametrize(
    ("kind", "width", "pattern", "share"),
    [
        ("triangle", 4.0, "triangles", 2 * 3**0.5),
        ("kagome", 8.5, "stars", 3**0.5),
    ],
)
def test_side_of_the_slicers_cells_is_found_again(kind, width, pattern, share):
    """Sides of 2 sqrt3 s / r and sqrt3 s / r. 4 x 4 cells."""
    side, rows = 4e-3, 4 * (2 if kind == "kagome" else 1)
    box = {"width": (width + (0.0 if kind == "triangle" else -0.5)) * side}
    box |= {"height": rows * 0.75**0.5 * side, "cells_x": 4, "cells_y": 4}
    found = settings(kind=kind, **box, wall_thickness=LINE)
    assert (found.pattern, found.infill) == (pattern, pytest.approx(share * LINE / side, rel=0.05))


@pytest.mark.parametrize(("orientation", "angle"), [("pointy", 30.0), ("flat", 0.0)])
def test_walls_of_a_honeycomb_are_thicker_than_a_line(orientation, angle):
    """Side 2 s / (sqrt3 r), mean wall 4 s / 3."""
    side = 3e-3
    size = {"width": 4.5 * 3**0.5 * side, "height": 6.5 * side}
    size = size if orientation == "pointy" else {"width": size["height"], "height": size["width"]}
    cells = {"cells_x": 4, "cells_y": 4}
    found = settings(
        kind="hex", orientation=orientation, **size, **cells, wall_thickness=4.0 * LINE / 3.0
    )
    assert (found.pattern, found.infill) == ("honeycomb", pytest.approx(2 * LINE / (3**0.5 * side)))
    assert degrees(found.fill_angle) == pytest.approx(angle)
    assert found.line_width == pytest.approx(0.45e-3)


@pytest.mark.parametrize(
    "lattice",
    [
        {"kind": "reentrant"},
        {"wall_thickness": 1.2e-3},
        {"wall_thickness": 0.2e-3},
        {"cells_x": 3, "cells_y": 4},
        {"grading": 1.5},
    ],
)
def test_other_designs_correspond_to_no_slicer(lattice):
    usual = {"wall_thickness": LINE, "cells_x": 4, "cells_y": 4}
    assert settings(**usual, **BOX) is not None
    assert settings(**usual | lattice, **BOX) is None
