"""The outline of the print: its area, its place, panels."""

import numpy as np
import pytest
import shapely

from sweep.design.network import Network
from sweep.export.design import design_of
from sweep.export.errors import ExportError
from sweep.export.outline import block, outline, panel, rings, specimen
from tests.support.results.exported import grid

T, SIDE = 0.8, 12.5  # mm: wall thickness, width over centre lines


def part(cells=3, **changes):
    design = design_of(grid(cells, **changes))
    return design, outline(design.network)


@pytest.mark.parametrize("cells", [1, 2, 5])
def test_area_of_a_grid_is_its_square_without_its_openings(cells):
    """(n p + t)^2 - n^2 (p - t)^2."""
    _, shape = part(cells)
    area = (SIDE + T) ** 2 - cells**2 * (SIDE / cells - T) ** 2
    assert shape.area == pytest.approx(area, rel=1e-5)
    assert shape.bounds == pytest.approx((0.0, 0.0, SIDE + T, SIDE + T), abs=1e-4)
    assert len(shape.interiors) == cells**2


def test_outer_rings_turn_left_and_openings_right():
    design, shape = part()
    found = rings(specimen(design, shape))
    turns = [shapely.is_ccw(shapely.linearrings(ring)) for ring in found]
    assert turns == [True] + [False] * 9
    assert all(np.array_equal(ring[0], ring[-1]) for ring in found)


def test_a_specimen_is_as_deep_and_as_heavy_as_the_case():
    design, shape = part(depth=15e-3)
    found = specimen(design, shape)
    assert (found.depth, found.specimens) == (15.0, 1)
    assert found.grams == design.grams > 1.0


def test_panel_has_whole_specimens_that_do_not_touch():
    design, shape = part()
    found = panel(design, shape, (0.1, 0.05))
    boxes = np.array([piece.bounds for piece in shapely.get_parts(found.shape)])
    assert len(boxes) == 7
    assert (boxes[0, 0], boxes[-1, 2]) == pytest.approx((0.0, 7 * (SIDE + T + 0.4) - 0.4), abs=1e-4)
    gaps = boxes[1:, 0] - boxes[:-1, 2]
    assert gaps == pytest.approx(0.4, abs=1e-4)
    assert (found.across, found.behind, found.specimens) == (7, 4, 28)
    assert found.grams == pytest.approx(28 * design.grams)
    assert found.depth == 48.0


def test_corners_that_stick_out_do_not_touch():
    """The tips of a diamond of thick walls are farther out than half a wall."""
    design, shape = part(kind="diamond", cells=2, wall_thickness=1.6e-3)
    assert shape.bounds[2] > 12.5 + 1.6 + 0.4
    found = panel(design, shape, (0.1, 0.05))
    boxes = np.array([piece.bounds for piece in shapely.get_parts(found.shape)])
    assert len(boxes) == found.across == 7
    assert boxes[1:, 0] - boxes[:-1, 2] == pytest.approx(0.4, abs=1e-4)


@pytest.mark.parametrize(
    ("sides", "asked", "one"), [((6e-3, 0.05), 6, 13.3), ((0.05, 5e-3), 5, 12)]
)
def test_panel_that_holds_nothing_is_refused(sides, asked, one):
    with pytest.raises(
        ExportError, match=rf"{asked} mm is smaller than half of a specimen of {one} mm; allowed"
    ):
        panel(*part(), sides)


def test_panel_in_metres_instead_of_millimetres_is_refused():
    with pytest.raises(ExportError, match=r"panel of [\d,]+ specimens; allowed: at most 2,000"):
        panel(*part(), (100.0, 50.0))


def test_block_is_the_box_round_the_walls():
    design, shape = part(perimeters=2)
    assert block(design.lattice).bounds == pytest.approx(shape.bounds, abs=1e-4)


def test_walls_that_do_not_hang_together_are_refused():
    points = 1e-3 * np.array([[0.0, 0], [5, 0], [0, 5], [5, 5]])
    apart = Network(points, np.array([[0, 1], [2, 3]]), np.full(2, 8e-4), *2 * [np.empty(0, int)])
    with pytest.raises(ExportError, match="are not connected: 2 pieces"):
        outline(apart)


def test_gaps_of_round_off_are_closed():
    """Two walls side by side, 1 um apart, are one; 10 um apart they are two."""
    for gap, pieces in {1e-6: 1, 10e-6: 2}.items():
        points = 1e-3 * np.array([[0.0, 0], [5, 0], [0, 0.8 + 1e3 * gap], [5, 0.8 + 1e3 * gap]])
        none = np.empty(0, int)
        walls = Network(points, np.array([[0, 1], [2, 3]]), np.full(2, 8e-4), none, none)
        if pieces == 1:
            assert outline(walls).area == pytest.approx(5 * 1.601, rel=1e-4)
        else:
            with pytest.raises(ExportError):
                outline(walls)
