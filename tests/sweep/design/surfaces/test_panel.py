"""Panels of sheets: their boxes, and that their faces cut the sheet steeply."""

import numpy as np
import pytest

from sweep.design.surfaces.names import SHEETS
from sweep.design.surfaces.panel import net_of, net_of_block, printed_thickness

PANELS = [(name, turned) for name in SHEETS for turned in (False, True)]


@pytest.mark.parametrize(("name", "turned"), PANELS)
def test_a_box_repeats_along_x_and_y_and_its_faces_cut_the_sheet_steeply(name, turned):
    cut = SHEETS[name].cut(turned)
    net = net_of(name, turned, 3.0, 12 * cut.step, 12)
    box = net.box
    np.testing.assert_allclose(box.size, [3 * cut.across, 3 * cut.along, 12 * cut.step])
    points = np.random.default_rng(2).uniform(0, 1, (20, 3)) * box.size
    for axis in (0, 1):
        moved = points + box.size[axis] * np.eye(3)[axis]
        np.testing.assert_allclose(box.value(moved), box.value(points), atol=1e-12)
    for outer in (net.bottom, net.top):
        assert np.hypot(*net.normals[outer, :2].T).min() > 0.75


@pytest.mark.parametrize("name", SHEETS)
def test_a_turned_panel_is_pressed_between_two_axes_and_has_the_third_one_across(name):
    phase = net_of(name, True, 3.0, 12 * SHEETS[name].turned.step, 8).box.phase
    np.testing.assert_allclose(phase[:, 2], 2 * np.pi / 3.0 * np.array([1, 1, 0]) / np.sqrt(2))
    np.testing.assert_allclose(phase[:, 1], 2 * np.pi / 3.0 * np.array([0, 0, 1]))


def test_areas_and_steepness_are_those_of_fine_nets():
    for name, sheet in SHEETS.items():
        net = net_of(name, False, 1.0, 1.0, 16)
        area, steep = net.area.sum(), np.hypot(*net.directions[:, :2].T)
        assert sheet.area == pytest.approx(area, rel=7e-3)
        assert sheet.steep == pytest.approx(np.average(steep, weights=net.area), rel=5e-3)


@pytest.mark.parametrize("along", [False, True])
def test_a_printed_sheet_is_thinner_where_it_lies_flat_and_never_below_a_layer(along):
    upward = np.array([0.0, 0.6, 1.0])
    level = np.sqrt(1.0 - upward**2)
    normals = np.column_stack([level, 0.0 * level, upward])
    normals = normals if along else normals[:, [0, 2, 1]]
    np.testing.assert_allclose(printed_thickness(0.5, 0.2, normals, along), [0.5, 0.4, 0.2])


@pytest.mark.parametrize("name", SHEETS)
def test_a_block_meets_its_faces_steeply_and_no_corner_is_near_the_sheet(name):
    net = net_of_block(name, 1.0, (1.0, 0.5, 1.5), (0, 1), 12)
    for axis in range(3):
        outer = net.on_surface & (net.face[:, axis] != 0)
        assert np.abs(net.normals[outer, axis]).max() < 0.7
    corners = np.stack(np.meshgrid(*([0.0, side] for side in net.box.size)), -1).reshape(-1, 3)
    assert np.abs(net.box.value(corners)).min() > 0.7
