"""Walls as long polylines: every element once, straight on at joints, corners in place."""

import re
from base64 import b64decode

import numpy as np
import pytest

from sweep.report.page.trails import FRAMES, at_rest, drawing, moving_shape, trails
from tests.support.results.specimens import squeezed_cell, tube

CROSS = np.array([[0, 0], [1, 0], [2, 0], [1, 1], [1, -1]]) * 1e-3
ARMS = np.array([[0, 1], [1, 2], [1, 3], [4, 1]])
T = np.full(4, 1e-4)


def test_trails_go_straight_on_at_a_crossing():
    nodes = sorted(sorted([t.nodes, t.nodes[::-1]])[0] for t in trails(CROSS, ARMS, T))
    assert nodes == [[0, 1, 2], [3, 1, 4]]


def test_walls_of_other_thickness_are_other_trails():
    found = trails(CROSS, ARMS, np.array([1, 1, 1, 2]) * 1e-4)
    assert sorted((t.thickness, len(t.nodes)) for t in found) == [(1e-4, 2), (1e-4, 3), (2e-4, 2)]


@pytest.mark.parametrize("columns", [1, 2, 5])
def test_every_element_of_a_grid_is_drawn_once(columns):
    number = np.arange(3 * (columns + 1)).reshape(-1, 3)
    places = np.argwhere(number >= 0).astype(float)
    pairs = [(number[1:], number[:-1]), (number[:, 1:], number[:, :-1])]
    edges = np.concatenate([np.column_stack([a.ravel(), b.ravel()]) for a, b in pairs])
    found = trails(places, edges, np.ones(len(edges)))
    drawn = [sorted(pair) for t in found for pair in zip(t.nodes, t.nodes[1:], strict=False)]
    assert sorted(drawn) == sorted(map(sorted, edges.tolist()))


def test_drawing_has_the_corners_and_the_outer_size():
    cell = squeezed_cell()
    drawn = drawing(cell["position_m"][0], cell["edges"], cell["edge_thickness_m"])
    assert drawn["box"] == [-0.5, -0.5, 11.0, 11.0]
    assert drawn["walls"] == [[1.0, "M0 0l1000 0 0 1000 -1000 0 0 -1000"]]


def test_nodes_in_straight_walls_are_not_drawn():
    x = np.linspace(0.0, 10.0, 11)
    bent = np.column_stack([x, 0.02 * np.sin(x)]) * 1e-3  # mm: less than 3 % of the thickness
    edges = np.column_stack([np.arange(10), np.arange(1, 11)])
    (wall,) = drawing(bent, edges, np.full(10, 1e-3))["walls"]
    assert wall[1].count(" ") == 2
    (wall,) = drawing(bent * [1.0, 10.0], edges, np.full(10, 1e-3))["walls"]
    assert wall[1].count(" ") > 4


def test_moving_shape_can_be_read_back():
    cell = squeezed_cell()
    shape = moving_shape(cell, list(range(8)))
    counts = np.frombuffer(b64decode(shape["position"]), "<u2").reshape(8, 4, 2)
    position = np.array(shape["low"]) + shape["step"] * counts
    np.testing.assert_allclose(position, 1e3 * cell["position_m"], atol=1e-4)
    assert shape["force"] == list(range(8))
    assert (shape["plates"][3], shape["profiles"]) == ([-0.5, 7.5], [[], []])
    struck = moving_shape(cell | {"striker_m": np.full((3, 2), 2e-3)}, [0.0] * 8)
    assert struck["profiles"] == [[], [[[2.0, 2.0]] * 3]]


def test_many_frames_become_few_from_the_first_to_the_last():
    cell = squeezed_cell(heights=np.linspace(10.0, 5.0, 101), platens=False)
    shape = moving_shape(cell, [None] * 101)
    assert len(shape["strain"]) == FRAMES == len(shape["plates"])
    assert (shape["strain"][0], shape["strain"][-1]) == (0.0, 50.0)
    assert shape["plates"][0] == [None, None]


@pytest.mark.parametrize("down", [20, 37, 55])
def test_a_motion_keeps_the_frames_at_which_it_turns(down):
    """Down and up twice: neither turn is among the evenly spaced frames."""
    way = np.append(np.linspace(0.0, 6.0, down), np.linspace(6.0, 0.5, 41)[1:])
    shape = moving_shape(squeezed_cell(heights=10.0 - np.append(way, way)), [None] * (2 * len(way)))
    strain = np.array(shape["strain"])
    assert len(strain) <= FRAMES
    assert strain[[0, -1]].tolist() == [0.0, 5.0]
    assert (strain == 60.0).sum() == 2


def test_path_of_a_drawing_holds_only_numbers():
    cell = squeezed_cell()
    (wall,) = drawing(cell["position_m"][5], cell["edges"], cell["edge_thickness_m"])["walls"]
    assert re.fullmatch(r"(M-?\d+ -?\d+l(-?\d+ ?)+)+", wall[1])


def test_plan_of_a_tube_is_a_square_of_its_thickness():
    position, edges, thickness = at_rest(tube())
    assert position.shape == (8, 2)
    assert sorted(map(sorted, edges.tolist())) == [[0, 1], [0, 3], [1, 2], [2, 3]]
    assert thickness == pytest.approx(1e-4)
    assert drawing(position, edges, thickness)["box"] == pytest.approx([-0.05, -0.05, 1.1, 1.1])
    turned = [np.roll(row, k) for k, row in enumerate(tube()["quads"])]
    np.testing.assert_array_equal(at_rest(tube() | {"quads": np.array(turned)})[1], edges)
