"""Plates as lines: their plan."""

import numpy as np
import pytest

from sweep.report.figures.flattened import plan
from sweep.report.page.trails import drawing
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
