"""The drawn shape is the printed one."""

import numpy as np
import pytest
import shapely

from sweep.design.silhouette import silhouette

T = 0.8


def union(position, edges, thickness=T):
    """The polygons of a shape as one area, having checked that each turns anticlockwise."""
    edges = np.array(edges)
    thickness = np.broadcast_to(thickness, len(edges))
    loops = silhouette(np.array(position, float), edges, thickness)
    polygons = [shapely.Polygon(loop) for loop in loops]
    assert all(p.exterior.is_ccw for p in polygons)
    return shapely.union_all(polygons)


@pytest.mark.parametrize("angle", [0.3, 1.2, 2.0, -0.7, -1.9])
def test_bend_is_mitred(angle):
    tip = (5.0 + 5.0 * np.cos(angle), 5.0 * np.sin(angle))
    centre_line = [(0.0, 0.0), (5.0, 0.0), tip]
    expected = shapely.LineString(centre_line).buffer(0.5 * T, cap_style="flat", join_style="mitre")
    assert union(centre_line, [(0, 1), (2, 1)]).area == pytest.approx(expected.area, rel=1e-12)


def test_straight_wall_needs_no_mitre():
    loops = silhouette(
        np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), np.array([[0, 1], [1, 2]]), np.full(2, T)
    )
    assert len(loops) == 2


def test_folded_wall_stays_near_its_node():
    area = union([(0.0, 0.0), (5.0, 0.0), (0.0, 0.01)], [(0, 1), (1, 2)])
    assert area.bounds[2] < 5.0 + 2.0 * T


@pytest.mark.parametrize("thin", [0.8, 0.3])
def test_corner_of_unlike_walls_is_where_their_sides_meet(thin):
    """Two walls at a right angle: each as long as the other is thick, and their common corner."""
    found = union([(5.0, 0.0), (0.0, 0.0), (0.0, 5.0)], [(0, 1), (1, 2)], [T, thin])
    assert found.area == pytest.approx(5.0 * T + 5.0 * thin)
    assert found.bounds == pytest.approx((-0.5 * thin, -0.5 * T, 5.0, 5.0))


@pytest.mark.parametrize("angle", [2.0, 2.2, -2.0])
def test_sharp_corner_of_unlike_walls_stays_between_their_sides(angle):
    """The sides of the thick wall bound the union, wherever a thin one leaves it."""
    position = [(5.0, 0.0), (0.0, 0.0), (5.0 * np.cos(angle), 5.0 * np.sin(angle))]
    found = union(position, [(0, 1), (1, 2)], [T, 0.4])
    side = -0.5 * T * np.sign(angle)
    beyond = found.bounds[1] if angle > 0 else found.bounds[3]
    assert beyond == pytest.approx(side)


@pytest.mark.parametrize("thin", [0.05 * T, 0.4 * T, T])
@pytest.mark.parametrize("angle", np.linspace(0.05, 2.0 * np.pi - 0.05, 24))
def test_all_polygons_are_convex(angle, thin):
    """The exact area of a print needs convex ones, however sharp a bend and unlike its walls."""
    position = np.array([[-9.0, 0.0], [0.0, 0.0], [9.0 * np.cos(angle), 9.0 * np.sin(angle)]])
    loops = np.array(silhouette(position, np.array([[0, 1], [1, 2]]), np.array([T, thin])))
    sides = np.diff(loops, axis=1)
    x, y = np.moveaxis(np.concatenate([sides, sides[:, :1]], axis=1), 2, 0)
    assert np.all(x[:, :-1] * y[:, 1:] - y[:, :-1] * x[:, 1:] >= -1e-12)
