"""Panels of sheets: their boxes, and that their faces cut the sheet steeply."""

import numpy as np
import pytest

from sweep.design.surfaces.names import SHEETS
from sweep.design.surfaces.panel import net_of

PANELS = [(name, way) for name in SHEETS for way in SHEETS[name].cuts]


@pytest.mark.parametrize(("name", "way"), PANELS)
def test_a_box_repeats_along_x_and_y(name, way):
    cut = SHEETS[name].cuts[way]
    box = net_of(name, way, 3.0, 12 * cut.step, 8).box
    np.testing.assert_allclose(box.size, [3 * cut.across, 3 * cut.along, 12 * cut.step])
    points = np.random.default_rng(2).uniform(0, 1, (20, 3)) * box.size
    for axis in (0, 1):
        moved = points + box.size[axis] * np.eye(3)[axis]
        np.testing.assert_allclose(box.value(moved), box.value(points), atol=1e-12)


@pytest.mark.parametrize(("name", "way"), PANELS)
def test_the_print_axis_is_pressed_or_across(name, way):
    box = net_of(name, way, 3.0, 12 * SHEETS[name].cuts[way].step, 8).box
    printed = 2 if way == "out_of_plane" else 1  # axis of the box along which layers are stacked
    assert np.argmax(np.abs(box.phase[2])) == printed


@pytest.mark.parametrize(("name", "way"), PANELS)
def test_the_sheet_meets_both_faces_steeply(name, way):
    net = net_of(name, way, 1.0, 4 * SHEETS[name].cuts[way].step, 12)
    for outer in (net.bottom, net.top):
        assert np.hypot(*net.normals[outer, :2].T).min() > 0.75


def test_areas_and_steepness_are_those_of_fine_nets():
    for name, sheet in SHEETS.items():
        net = net_of(name, "out_of_plane", 1.0, 1.0, 16)
        area, steep = net.area.sum(), np.hypot(*net.directions[:, :2].T)
        assert sheet.area == pytest.approx(area, rel=7e-3)
        assert sheet.steep == pytest.approx(np.average(steep, weights=net.area), rel=5e-3)
