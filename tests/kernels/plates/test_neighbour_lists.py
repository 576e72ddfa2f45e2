"""How far a step of plates may go: nothing meets, and no node turns far."""

import numpy as np
import pytest

from kernels.plates import neighbour_lists
from kernels.plates.neighbour_lists import MOST_TURN
from tests.support.kernels.pressed_plates import SIDE, T, pinched, scene, shaken, whole
from tests.support.kernels.solving import neighbours_of
from tests.support.kernels.surfaces import crossings


def limit(of, x, dx):
    """Admissible share of ``dx``, with lists for the whole move."""
    args = whole(of, x)
    far = args.problem.travel(dx)
    there = args.beside(neighbours_of(x, of.terms, far)).problem
    assert there.covers(x, far)
    return there.step_limit(x, dx, far)


def pushed(of, side, by):
    """A move of the middle of the wall at x = ``side`` by ``by`` m along x."""
    dx, mesh = np.zeros(of.x_rest.size), of.mesh
    middle = mesh.flat & (mesh.level == 3) & (np.abs(mesh.rest[:, 0] - side) < 0.3 * T)
    dx[6 * np.flatnonzero(middle)] = by
    return dx


def test_a_wall_may_move_up_to_another_but_not_through_it():
    of = scene("glued")
    assert limit(of, of.x_rest, pushed(of, 0.0, 0.5 * SIDE)) == 1.0
    share = limit(of, of.x_rest, pushed(of, 0.0, 0.5 * SIDE) - pushed(of, SIDE, 0.6 * SIDE))
    assert 0.7 < share * 1.1 < 1.0


def test_nor_through_a_platen_or_the_plane_of_its_image():
    of = scene("loose quarter")
    dx = np.zeros(of.x_rest.size)
    dx[-1] = -0.5 * T
    assert limit(of, of.x_rest, dx) == pytest.approx(0.9)  # it starts half a thickness away
    assert limit(of, of.x_rest, pushed(of, 0.0, 0.4 * SIDE)) == 1.0
    assert 0.6 < limit(of, of.x_rest, pushed(of, 0.0, 0.7 * SIDE)) < 5.0 / 7.0


def test_no_node_turns_far():
    of, turn = scene("glued"), 0.4
    dx, inner = np.zeros(of.x_rest.size), np.flatnonzero(of.mesh.flat)[0]
    dx[6 * inner + 3 : 6 * inner + 6] = 0.6 * turn, -0.8 * turn, 0.0
    assert limit(of, of.x_rest, dx) == pytest.approx(MOST_TURN / turn)


@pytest.mark.parametrize("seed", range(2))
def test_any_admissible_move_leaves_walls_apart(seed):
    of = scene("glued")
    x, touch = pinched(of), of.terms.contact
    dx = shaken(of, np.zeros_like(x), seed, 3.0)
    share = limit(of, x, dx)
    assert 0.0 < share < 1.0
    assert crossings(x, touch) == (0, 0)
    assert crossings(x + share * dx, touch) == (0, 0)
    assert crossings(x + dx, touch)[0] > 0


def test_lists_hold_while_nodes_move_less_than_half_of_the_margin():
    of = scene("glued")
    problem = whole(of, of.x_rest).problem
    half = 0.5 * neighbour_lists.MARGIN * of.terms.contact.reach
    assert problem.covers(of.x_rest, 0.99 * half)
    assert not problem.covers(of.x_rest, 1.01 * half)
    moved = of.x_rest.copy()
    moved[6 * 40 : 6 * 40 + 3] += 0.5 * half / np.sqrt(3.0)
    assert problem.covers(moved, 0.49 * half)
    assert not problem.covers(moved, 0.51 * half)


def test_longer_moves_are_measured_in_one_go_and_no_longer_than_lists_cover():
    of = scene("glued")
    dx = pushed(of, 0.0, 1e-3)
    problem = whole(of, of.x_rest).problem
    assert problem.travel(dx) == pytest.approx(1e-3)
    assert problem.travel(1e3 * dx) == of.terms.contact.most_move


def test_the_least_gap_is_that_of_the_nearest_nodes_and_triangles():
    """A node inside a wall next to the other wall; a platen is farther away."""
    of = scene("glued")
    x, touch, mesh = of.x_rest.copy(), of.terms.contact, of.mesh
    node = int(np.flatnonzero(pushed(of, 0.0, 1.0))[0] // 6)
    x[6 * node] = SIDE - 0.5 * T
    wall = np.abs(mesh.rest[:, 0] - SIDE) < 0.3 * T
    x[:-2].reshape(-1, 6)[wall, 0] = SIDE
    assert neighbour_lists.least_gap(whole(of, x).problem, x) == pytest.approx(0.5 * T)
    x[touch.high] = x[:-2].reshape(-1, 6)[touch.high_nodes, 2].max() + 0.3 * T
    assert neighbour_lists.least_gap(whole(of, x).problem, x) == pytest.approx(0.3 * T)
