"""Nets of quads on a surface: on it, closed except at the planes, even, and periodic; with walls.

Their functions too, whose gradients are differences, and their boxes, whose faces cut them steeply.
"""

import numpy as np
import pytest

from sweep.design.surfaces.level_set import LEVEL_SETS, LevelSet
from sweep.design.surfaces.names import SHEETS
from sweep.design.surfaces.nets import GOOD, GOOD_BESIDE_WALLS, Box, build_net
from sweep.design.surfaces.panel import net_of, net_of_block, printed_thickness

PHASES = np.random.default_rng(1).uniform(0, 2 * np.pi, (50, 3))
STEP = 1e-5


@pytest.mark.parametrize("name", LEVEL_SETS)
def test_gradients_are_differences(name):
    of = LEVEL_SETS[name]
    found = of.gradient(PHASES)
    for k, way in enumerate(STEP * np.eye(3)):
        slope = (of.value(PHASES + way) - of.value(PHASES - way)) / (2 * STEP)
        np.testing.assert_allclose(found[:, k], slope, atol=1e-9)


@pytest.mark.parametrize("name", LEVEL_SETS)
def test_both_sides_of_the_sheet_and_all_axes_are_alike(name):
    """A shift by half a period, or an inversion, turns the function round."""
    value = LEVEL_SETS[name].value
    turned = -PHASES if name == "gyroid" else PHASES + np.pi
    np.testing.assert_allclose(value(turned), -value(PHASES), atol=1e-14)
    np.testing.assert_allclose(value(PHASES[:, [1, 2, 0]]), value(PHASES), atol=1e-14)


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
    return np.unique(rows, axis=0, return_counts=True)


@pytest.mark.parametrize(("name", "turned"), PANELS, ids=IDS)
def test_a_net_is_on_the_surface_and_even_and_open_only_on_the_planes(name, turned):
    net = panel(name, turned)
    slope = np.linalg.norm(net.box.gradient(net.points), axis=1)
    assert np.abs(net.box.value(net.points) / slope).max() < 1e-9
    np.testing.assert_array_equal(net.points[net.bottom, 2], 0.0)
    np.testing.assert_array_equal(net.points[net.top, 2], net.box.size[2])
    inner = np.setdiff1d(np.arange(len(net.points)), np.concatenate([net.bottom, net.top]))
    assert 0.0 < net.points[inner, 2].min() < net.points[inner, 2].max() < net.box.size[2]
    assert net.quality > GOOD
    facing = np.einsum("mci,mi->mc", net.normals[net.quads], net.directions)
    assert facing.min() > 0.4
    rows, counts = sides(net)
    both = [np.isin(rows[:, :2], nodes).all(axis=1) for nodes in (net.bottom, net.top)]
    np.testing.assert_array_equal(counts, np.where(np.logical_or(*both), 1, 2))


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


BLOCKS = [(name, walls) for name in ("gyroid", "schwarz_d") for walls in ((0, 1), (0, 2))]
SIZE = np.array([3.0, 2.0, 2.0])


def block(name, walls):
    """A block of three by two by two halves of a period of 2."""
    return net_of_block(name, 2.0, tuple(SIZE), walls, 8)


@pytest.mark.parametrize(("name", "walls"), BLOCKS)
def test_walls_cover_the_faces_of_a_block_and_share_nodes_with_the_surface(name, walls):
    net = block(name, walls)
    assert net.quality > GOOD_BESIDE_WALLS
    slope = np.linalg.norm(net.box.gradient(net.points), axis=1)
    away = np.abs(net.box.value(net.points) / slope)[net.on_surface]
    assert away.max() < 1e-9
    ends = np.where(net.face > 0, SIZE, 0.0)
    np.testing.assert_array_equal(net.points[net.face != 0], ends[net.face != 0])
    for axis in range(3):
        covered = net.area[net.wall == axis].sum()
        assert covered == pytest.approx((axis in walls) * 2 * SIZE.prod() / SIZE[axis], rel=1e-12)
    facing = np.einsum("mci,mi->mc", net.corner_normals, net.directions)
    assert facing.min() > 0.4
    np.testing.assert_allclose(facing[net.wall >= 0], 1.0, rtol=1e-12)


@pytest.mark.parametrize(("name", "walls"), BLOCKS)
def test_three_quads_meet_along_a_curve_and_two_where_walls_meet(name, walls):
    net = block(name, walls)
    ends = np.sort(np.stack([net.quads, np.roll(net.quads, -1, axis=1)], axis=-1).reshape(-1, 2))
    wall = np.repeat(net.wall, 4)
    rows, number = np.unique(ends, axis=0, return_inverse=True)
    count = np.bincount(number.ravel())
    of_surface = np.bincount(number.ravel(), wall < 0)
    on = (net.face[rows[:, 0]] == net.face[rows[:, 1]]) & (net.face[rows[:, 0]] != 0)
    expected = np.where(on.any(axis=1), 0, 2)
    for axis in walls:  # two quads of a wall, or one at the end of the wall
        expected += on[:, axis] * np.where(on.sum(axis=1) == 2, 1, 2)
    expected += (of_surface == 1) & on.any(axis=1)
    np.testing.assert_array_equal(count, expected)
    assert np.any(count == 3)


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
