"""The area that walls cover, against closed forms and against shapely."""

import numpy as np
import pytest
import shapely

from sweep.design import area
from sweep.design.area import covered_area, united_area

WALL = np.array([[0, 1]])


def by_shapely(points, edges, thickness):
    lines = shapely.linestrings(points[edges])
    return shapely.area(shapely.union_all(shapely.buffer(lines, 0.5 * thickness, quad_segs=200)))


def tangle(count=30):
    """Walls of any thickness over one another, far off the origin."""
    random = np.random.default_rng(3)
    edges = np.column_stack([np.arange(count), np.arange(1, count + 1)])
    return random.random((count + 1, 2)) - 7.0, edges, random.uniform(0.02, 0.06, count)


@pytest.mark.parametrize("turn", np.append(np.linspace(0.0, 3.0, 13), [-0.4, 0.5 * np.pi - 0.4]))
def test_a_wall_has_round_ends(turn):
    """However it lies, along the lines and across them too."""
    points = np.array([[0.0, 0.0], [np.cos(turn), np.sin(turn)]])
    exact = 0.1 + np.pi * 0.05**2
    assert covered_area(points, WALL, np.array([0.1])) == pytest.approx(exact, rel=4e-3)


def test_a_node_without_walls_covers_nothing():
    points, thickness = np.array([[0.0, 0.0], [1.0, 0.0], [5.0, 5.0]]), np.array([0.1])
    assert covered_area(points, WALL, thickness) == covered_area(points[:2], WALL, thickness)


@pytest.mark.parametrize("away", [1e9, 1e155, 1e308])
def test_walls_without_measure_have_no_area(away):
    points = np.array([[0.0, 0.0], [1.0, 0.0], [away, 0.0]])
    found = covered_area(points, np.array([[0, 1], [1, 2]]), np.full(2, 0.1))
    assert np.isnan(found)
    lone = covered_area(points, WALL, np.array([0.1]))
    assert lone == pytest.approx(0.1 + np.pi * 0.05**2, rel=4e-3)


def test_a_tangle_has_the_area_that_shapely_finds_in_bands_and_far_away_too(monkeypatch):
    points, edges, thickness = walls = tangle()
    found = covered_area(*walls)
    assert found == pytest.approx(by_shapely(*walls), rel=3e-4)
    assert covered_area(points + 1e3, edges, thickness) == pytest.approx(found, rel=1e-9)
    monkeypatch.setattr(area, "CHUNK", 100)
    assert covered_area(*walls) == pytest.approx(found, rel=1e-12)


def test_walls_without_length_and_points_that_are_none():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]])
    found = covered_area(points, np.array([[0, 1], [1, 2]]), np.full(2, 0.1))
    assert found == pytest.approx(0.1 + np.pi * 0.05**2, rel=4e-3)
    assert np.isnan(covered_area(np.full((2, 2), np.nan), WALL, np.array([0.1])))


def test_a_wall_much_thinner_than_another_takes_no_more_lines_than_there_may_be():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.5], [1.0, 0.5]])
    found = covered_area(points, np.array([[0, 1], [2, 3]]), np.array([0.1, 1e-7]))
    assert found == pytest.approx(0.1 + np.pi * 0.05**2, rel=1e-4)


def test_the_error_falls_with_the_lines(monkeypatch):
    """The order is 3/2 at least, as for a disc."""
    exact, errors, lines = by_shapely(*tangle()), [], (4, 64)
    for count in lines:
        monkeypatch.setattr(area, "LINES", count)
        errors.append(abs(covered_area(*tangle()) / exact - 1.0))
    assert np.log(errors[0] / errors[1]) / np.log(lines[1] / lines[0]) > 1.5


def rectangle(left, bottom, right, top):
    corners = (left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)
    return np.array(corners, float)


SQUARE = rectangle(0, 0, 1, 1)
UNIONS = {
    "twice": ([SQUARE, SQUARE], 1.0),
    "inside another": ([SQUARE, rectangle(0.2, 0.3, 0.4, 0.5)], 1.0),
    "on a side": ([SQUARE, rectangle(1, 0.25, 2, 0.75)], 1.5),
    "at a corner": ([SQUARE, rectangle(1, 1, 3, 3)], 5.0),
    "across": ([rectangle(-2, 0, 3, 1), rectangle(0, -2, 1, 3)], 9.0),
    "without area": ([SQUARE, np.array([(0.5, 0.5), (0.5, 0.5), (2, 2), (2, 2), (0.5, 0.5)])], 1.0),
}


@pytest.mark.parametrize("turn", [0.0, 0.3, np.pi / 4])
@pytest.mark.parametrize("case", UNIONS)
def test_united_area_by_hand(case, turn):
    loops, expected = UNIONS[case]
    turned = np.array(loops) @ [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
    assert united_area(turned) == pytest.approx(expected, rel=1e-13)
    far = turned[::-1] + np.array([1e3, -1e3])
    assert united_area(far) == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize(("count", "corners"), [(3, 3), (30, 4), (200, 7)])
def test_polygons_in_a_heap_have_the_area_that_shapely_finds(count, corners):
    """Each with its corners on a circle, so that it is convex; of 200, there are many heights."""
    random = np.random.default_rng(count)
    angle = np.sort(random.uniform(0.0, 2.0 * np.pi, (count, corners)), axis=1)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=2)
    heap = random.uniform(0.5, 2.0, (count, 1, 1)) * circle + random.uniform(-3, 3, (count, 1, 2))
    heap = np.concatenate([heap, heap[:, :1]], axis=1)
    expected = shapely.area(shapely.union_all(shapely.polygons(heap)))
    assert united_area(heap) == pytest.approx(expected, rel=1e-12)
