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


@pytest.mark.parametrize(
    "shape", [{}, {"kind": "diamond", "cells": 2, "wall_thickness": 1.6e-3}], ids=["plain", "tips"]
)
def test_panel_has_whole_specimens_that_do_not_touch(shape):
    """The tips of a diamond of thick walls are farther out than half a wall."""
    design, drawn = part(**shape)
    assert (drawn.bounds[2] > 12.5 + 1.6 + 0.4) == bool(shape)
    found = panel(design, drawn, (0.1, 0.05))
    boxes = np.array([piece.bounds for piece in shapely.get_parts(found.shape)])
    assert len(boxes) == 7
    assert boxes[0, 0] == pytest.approx(0.0, abs=1e-4)
    assert boxes[1:, 0] - boxes[:-1, 2] == pytest.approx(0.4, abs=1e-4)
    assert (found.across, found.behind, found.specimens, found.depth) == (7, 4, 28, 48.0)
    assert found.grams == pytest.approx(28 * design.grams)


@pytest.mark.parametrize(
    ("sides", "why"),
    [
        ((6e-3, 0.05), "6 mm is smaller than half of a specimen of 13.3 mm; allowed"),
        ((0.05, 5e-3), "5 mm is smaller than half of a specimen of 12 mm; allowed"),
        ((100.0, 50.0), r"panel of [\d,]+ specimens; allowed: at most 2,000"),
    ],
)
def test_panel_that_holds_nothing_or_too_much_is_refused(sides, why):
    with pytest.raises(ExportError, match=why):
        panel(*part(), sides)


def test_block_is_the_box_round_the_walls():
    design, shape = part(perimeters=2)
    assert block(design.case.lattice).bounds == pytest.approx(shape.bounds, abs=1e-4)


def test_gaps_of_round_off_are_closed_and_others_refused():
    """Two walls side by side, 1 um apart, are one; 10 um apart they are two."""

    def walls(gap):
        points = 1e-3 * np.array([[0.0, 0], [5, 0], [0, 0.8 + gap], [5, 0.8 + gap]])
        none = np.empty(0, int)
        return Network(points, np.array([[0, 1], [2, 3]]), np.full(2, 8e-4), none, none)

    assert outline(walls(1e-3)).area == pytest.approx(5 * 1.601, rel=1e-4)
    with pytest.raises(ExportError, match="are not connected: 2 pieces"):
        outline(walls(10e-3))
