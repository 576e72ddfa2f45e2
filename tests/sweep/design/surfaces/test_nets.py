"""Nets of quads on a surface: on it, closed but for the planes, even, and periodic."""

import numpy as np
import pytest

from sweep.design.surfaces.level_set import LevelSet
from sweep.design.surfaces.names import SHEETS
from sweep.design.surfaces.nets import GOOD, Box, build_net
from sweep.design.surfaces.panel import net_of

PANELS = [(name, turned) for name in SHEETS for turned in (False, True)]
IDS = [f"{name}{', turned' * turned}" for name, turned in PANELS]


def panel(name, turned, quads=8):
    """A panel about one and a half periods high, of a period of 2."""
    return net_of(name, turned, 2.0, 2.0 * SHEETS[name].cut(turned).step * 4, quads)


def sides(net):
    """Each side of a quad, from its lower node up, with the shift between both, and its count."""
    one, two = net.quads, np.roll(net.quads, -1, axis=1)
    shift = np.roll(net.shift, -1, axis=1) - net.shift
    rows = np.concatenate([one[..., None], two[..., None], shift], axis=2).reshape(-1, 4)
    turned = rows[:, 0] > rows[:, 1]
    rows[turned] = rows[turned][:, [1, 0, 2, 3]] * [1, 1, -1, -1]
    return np.unique(rows, axis=0, return_counts=True), turned


@pytest.mark.parametrize(("name", "turned"), PANELS, ids=IDS)
def test_all_nodes_are_on_the_surface_and_the_outer_ones_on_the_planes(name, turned):
    net = panel(name, turned)
    slope = np.linalg.norm(net.box.gradient(net.points), axis=1)
    assert np.abs(net.box.value(net.points) / slope).max() < 1e-9
    np.testing.assert_array_equal(net.points[net.bottom, 2], 0.0)
    np.testing.assert_array_equal(net.points[net.top, 2], net.box.size[2])
    inner = np.setdiff1d(np.arange(len(net.points)), np.concatenate([net.bottom, net.top]))
    assert net.points[inner, 2].min() > 0.0
    assert net.points[inner, 2].max() < net.box.size[2]


@pytest.mark.parametrize(("name", "turned"), PANELS, ids=IDS)
def test_sides_belong_to_two_quads_but_for_those_on_the_planes(name, turned):
    net = panel(name, turned)
    (rows, counts), _ = sides(net)
    both = [np.isin(rows[:, :2], nodes).all(axis=1) for nodes in (net.bottom, net.top)]
    outer = np.logical_or(*both)
    np.testing.assert_array_equal(counts[~outer], 2)
    np.testing.assert_array_equal(counts[outer], 1)


@pytest.mark.parametrize(("name", "turned"), PANELS, ids=IDS)
def test_quads_are_even_and_face_the_gradient(name, turned):
    net = panel(name, turned)
    assert net.quality > GOOD
    facing = np.einsum("mci,mi->mc", net.normals[net.quads], net.directions)
    assert facing.min() > 0.4


def test_areas_converge_to_that_of_the_surface_with_the_second_order():
    errors = []
    for quads in (8, 16):
        net = net_of("gyroid", False, 2.0, 4.0, quads)
        errors.append(net.area.sum() / (SHEETS["gyroid"].area * 8.0) - 1.0)
    assert 0.0 < errors[0] < 0.02
    assert errors[1] < 0.3 * errors[0]


def test_a_plane_is_a_grid_of_squares():
    """A surface without curvature: equal squares of its height over the cells."""
    plane = LevelSet(
        lambda p: np.sin(p[:, 0]), lambda p: np.column_stack([np.cos(p[:, 0]), 0.0 * p[:, 1:]])
    )
    box = Box(plane, np.array([1.0, 1.0, 1.0]), 2 * np.pi * np.eye(3), np.array([0.4, 0.0, 0.0]))
    net = build_net(box, (8, 8, 8))
    assert len(net.quads) == 2 * 64
    np.testing.assert_allclose(net.area, 1.0 / 64, rtol=1e-6)
    assert net.quality == pytest.approx(1.0, rel=1e-6)
