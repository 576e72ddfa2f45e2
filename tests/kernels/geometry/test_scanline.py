"""Area of walls by scanlines, against closed forms and shapely.

More in tests/sweep/design/test_area.py, through the function that the program calls.
"""

import numpy as np
import pytest
import shapely

from kernels.geometry.scanline import covered_area

WALL = np.array([[0, 1]])


def by_shapely(points, edges, thickness):
    walls = shapely.buffer(shapely.linestrings(points[edges]), 0.5 * thickness, quad_segs=300)
    return shapely.area(shapely.union_all(walls))


@pytest.mark.parametrize("together", [1 << 19, 40])
@pytest.mark.parametrize("turn", [-0.4, 0.0, 0.7, 0.5 * np.pi - 0.4])
def test_a_wall_is_a_rectangle_with_round_ends(turn, together):
    """Along the lines and across them too, in memory at once or in bands."""
    points = 3.0 * np.array([[0.0, 0.0], [np.cos(turn), np.sin(turn)]])
    found = covered_area(points, WALL, np.array([0.2]), 200, together)
    assert found == pytest.approx(0.6 + np.pi * 0.01, rel=2e-4)


def test_a_wall_without_length_is_a_disc():
    found = covered_area(np.zeros((2, 2)), WALL, np.array([0.2]), 400, 1 << 19)
    assert found == pytest.approx(np.pi * 0.01, rel=3e-4)


def test_a_node_is_as_thick_as_the_thickest_of_its_walls():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    edges, thickness = np.array([[0, 1], [1, 2]]), np.array([0.1, 0.4])
    found = covered_area(points, edges, thickness, 64, 1 << 19)
    assert found == pytest.approx(by_shapely(points, edges, thickness), rel=3e-4)


def test_random_walls_cover_what_shapely_finds():
    random = np.random.default_rng(4)
    points, edges = random.random((40, 2)), random.integers(0, 40, (60, 2))
    edges = edges[edges[:, 0] != edges[:, 1]]
    used, edges = np.unique(edges, return_inverse=True)
    points, edges = points[used], edges.reshape(-1, 2)
    thickness = random.uniform(0.01, 0.03, len(edges))
    found = covered_area(points, edges, thickness, 32, 1 << 19)
    assert found == pytest.approx(by_shapely(points, edges, thickness), rel=1e-4)
