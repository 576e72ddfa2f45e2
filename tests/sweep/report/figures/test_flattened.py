"""Plates as lines: their plan, and their grid on the screen, for pages that draw only lines."""

import numpy as np
import pytest

from sweep.report.figures.flattened import THIN, lines, plan
from sweep.report.figures.shaded import seen
from sweep.report.page.trails import drawing, moving_shape
from tests.support.results.specimens import tube


def test_plan_of_a_tube_is_a_square_of_its_thickness():
    found = plan(tube())
    assert found["position_m"].shape == (1, 8, 2)
    assert sorted(map(sorted, found["edges"].tolist())) == [[0, 1], [0, 3], [1, 2], [2, 3]]
    assert found["edge_thickness_m"] == pytest.approx(1e-4)
    drawn = drawing(found["position_m"][0], found["edges"], found["edge_thickness_m"])
    assert drawn["box"] == pytest.approx([-0.05, -0.05, 1.1, 1.1])


def test_a_plan_has_the_sides_on_the_ground_wherever_quads_begin():
    frames = tube()
    quads = np.array([np.roll(row, k) for k, row in enumerate(frames["quads"])])
    found = plan(frames | {"quads": quads})
    np.testing.assert_array_equal(found["edges"], plan(frames)["edges"])


def test_lines_are_the_edges_of_the_quads_each_once():
    frames = tube()
    found = lines(frames)
    assert len(found["edges"]) == 12
    assert found["edge_thickness_m"] == pytest.approx(THIN * 1e-4)
    np.testing.assert_allclose(found["position_m"], seen(frames["position_m"])[0])
    assert np.isnan(found["plate_y_m"]).all()
    moving = moving_shape(found, [None] * 3)
    assert moving["nodes"] == 8
