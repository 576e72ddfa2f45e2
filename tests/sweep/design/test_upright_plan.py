"""The plan of upright walls: how joints turn, how walls are divided, quarters of plans."""

import numpy as np
import pytest

from sweep.design.drawing import connected
from sweep.design.geometry import Geometry
from sweep.design.infill import families, trait
from sweep.design.lattice import build_network
from sweep.design.upright_plan import (
    layers_of,
    mirror_fault,
    plan_of,
    quads_along,
    turns,
)
from tests.support.designs.plates import network

EVEN = ("circle", "diamond", "hex", "reentrant", "square")  # bricks have five sides at the edges


def drawn(kind, cells=3, box=(12e-3, 12e-3)):
    orientation = "pointy" if trait(kind, "ORIENTED") else None
    return build_network(Geometry(kind, orientation, (cells, cells), box, 0.3e-3))


@pytest.mark.parametrize("kind", families())
def test_neighbours_turn_oppositely_where_no_circuit_is_odd(kind):
    plan = drawn(kind)
    n = len(plan.points)
    one, other = turns(n, plan.walls)[plan.walls].T
    copies = [plan.walls + np.array(shift) for shift in ([0, n], [n, 0])]
    twice = np.concatenate(copies)  # in two parts if no circuit is odd
    even = connected(twice, 2 * n).max() == 1
    assert np.all(one == -other) == even, kind
    assert even or kind not in EVEN


def test_parts_that_are_not_connected_turn_too():
    assert turns(4, np.array([[0, 1], [2, 3]])).tolist() == [1, -1, 1, -1]


def test_quads_of_a_wall_are_as_wished_unless_it_is_too_thick():
    plan = plan_of(network([[0, 0], [6, 0], [6, 1]], [[0, 1], [1, 2]], [0.5e-3, 0.4e-3]))
    assert quads_along(plan, 6).tolist() == [6, 2]
    assert quads_along(plan, 20).tolist() == [12, 2]
    assert quads_along(plan, np.array([3, 1])).tolist() == [3, 1]
    assert quads_along(plan_of(network([[0, 0], [0.2, 0]], [[0, 1]])), 6).tolist() == [1]


def test_layers_are_as_high_as_quads_are_long():
    plan = plan_of(network([[0, 0], [6, 0], [6, 2]], [[0, 1], [1, 2]]))
    along = np.array([6, 2])  # quads of 1 mm
    assert layers_of(plan, along, 9.3e-3) == 9
    assert layers_of(plan, along, 0.1e-3) == 1
    thick = plan_of(network([[0, 0], [6, 0]], [[0, 1]], 0.9e-3))
    assert layers_of(thick, np.array([12]), 4e-3) == 4


@pytest.mark.parametrize("cells", [1, 3])
def test_quarter_of_an_odd_grid_is_a_quarter(cells):
    whole, quarter = (plan_of(drawn("square", cells), cut) for cut in (False, True))
    assert 4.0 * quarter.length.sum() == pytest.approx(whole.length.sum(), rel=1e-12)
    assert quarter.planes == pytest.approx([6e-3, 6e-3])
    assert np.all(quarter.points <= 6e-3)
    assert quarter.on.sum() == 2 * (cells + 1) // 2
    for axis in (0, 1):
        assert np.all(quarter.points[quarter.on[:, axis], axis] == 6e-3)
    assert np.allclose(quarter.span, 12e-3 / cells, rtol=1e-12)


def test_wall_that_is_cut_begins_at_its_joint_and_bows_as_before():
    """The bow of a wall is to the same side of the plan in the whole and in the quarter."""
    whole, quarter = (plan_of(drawn("square", 3), cut) for cut in (False, True))
    assert not quarter.on[quarter.walls[:, 0]].any()

    def sides(plan):
        start, end = plan.points[plan.walls].swapaxes(0, 1)
        along = (end - start) / plan.length[:, None]
        return start, end, plan.sign[:, None] * np.column_stack([along[:, 1], -along[:, 0]])

    start, end, side = sides(whole)
    known = {
        tuple(sorted([tuple(np.round(1e6 * a)), tuple(np.round(1e6 * b))])): s
        for a, b, s in zip(start, end, side, strict=True)
    }
    assert len(quarter.walls) == 8
    for a, b, s, span in zip(*sides(quarter), quarter.span, strict=True):
        far = a + (b - a) / np.linalg.norm(b - a) * span
        key = tuple(sorted([tuple(np.round(1e6 * a)), tuple(np.round(1e6 * far))]))
        assert s == pytest.approx(known[key], abs=1e-12)


def test_half_a_wall_has_half_the_quads():
    quarter = plan_of(drawn("square", 3), True)
    cut = quarter.length < 0.75 * quarter.span
    assert set(quads_along(quarter, 6)[cut]) == {3}
    assert set(quads_along(quarter, 5)[cut]) == {3}
    assert set(quads_along(quarter, 6)[~cut]) == {6}


@pytest.mark.parametrize(
    ("kind", "cells", "fault"),
    [
        ("square", 2, "joints lie on its middle planes"),
        ("hex", 3, "not symmetric about its middle"),
    ],
)
def test_what_has_no_quarter_says_why(kind, cells, fault):
    plan = drawn(kind, cells)
    assert fault in mirror_fault(plan)
    with pytest.raises(ValueError, match=fault):
        plan_of(plan, quarter=True)


def test_unequal_walls_are_not_symmetric():
    ring = [[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert mirror_fault(network(*ring)) == ""
    assert "not symmetric" in mirror_fault(network(*ring, [0.3e-3, 0.3e-3, 0.4e-3, 0.3e-3]))


def test_odd_circuits_do_not_buckle_symmetrically():
    """A joint and its image are joined by two walls, so that they turn alike."""
    points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, -1], [3, -1], [1, 5], [3, 5]]
    walls = [[0, 4], [4, 5], [5, 1], [1, 2], [0, 3], [3, 6], [6, 7], [7, 2]]
    walls += [[0, 5], [1, 4], [3, 7], [2, 6]]
    assert "do not buckle symmetrically" in mirror_fault(network(points, walls))
