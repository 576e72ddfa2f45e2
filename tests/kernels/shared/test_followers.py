"""Coordinates that follow others, as one matrix R (n, k): x = R q, so that forces on q are R^T g.

With a driven platen, or with prescribed moves, some coordinates are led; under a striker they are
tied to the platen. In one period of an endless lattice, images follow two others.
"""

import numpy as np
import pytest

from sweep.scene.custom import build_structure
from sweep.scene.periodic import build_periodic
from tests.support.designs import periods
from tests.support.designs.structures import BEAM, case_of
from tests.support.kernels import pressed_plates, solving, states
from tests.support.kernels.solving import moves

MOVE = -1e-4  # m
PULLED = {
    "prescribed": [
        {"node": 1, "direction": "x", "displacement_mm": 2.0},
        {"node": 1, "direction": "y", "displacement_mm": -5.0},
    ]
}


def in_the_plane(of):
    return solving.whole(of, of.x_rest).problem


def of_plates(name):
    of = pressed_plates.scene(name)
    return pressed_plates.whole(of, of.x_rest).problem


def prescribed():
    case = case_of(BEAM | PULLED, solver=dict(integrator="static"))
    return in_the_plane(build_structure(case))


def endless():
    """A period of a honeycomb, whose height is prescribed."""
    of = build_periodic(periods.pressed(periods.lattice_of("hex", (2, 2), 0.08)))
    assert len(of.terms.layout.images) > 0
    return in_the_plane(of)


DRIVEN = {
    "glued": lambda: in_the_plane(states.driven("glued")),
    "sliding": lambda: in_the_plane(states.driven("sliding")),
    "contact": lambda: in_the_plane(states.driven("contact")),
    "prescribed": prescribed,
    "endless": endless,
    "plates, glued": lambda: of_plates("glued"),
    "plates, loose": lambda: of_plates("loose quarter"),
}
PROBLEMS = DRIVEN | {"plates, struck": lambda: of_plates("struck")}
LOOSE = ["contact", "plates, loose"]  # platens that nothing follows


def random(problem, seed):
    return np.random.default_rng(seed).uniform(-1, 1, problem.scene.layout.leader.size)


@pytest.mark.parametrize("name", PROBLEMS)
def test_forces_on_tied_coordinates_act_on_their_leader(name):
    problem = PROBLEMS[name]()
    g, residual = random(problem, 0), random(problem, 1)
    (own, follows), expected = moves(problem.scene.layout), np.zeros(g.size)
    expected[own] = follows.T @ g
    problem.reduce(g, residual)
    np.testing.assert_allclose(residual, expected, rtol=1e-14, atol=1e-13)


@pytest.mark.parametrize("name", PROBLEMS)
def test_tied_coordinates_follow_their_leader(name):
    problem = PROBLEMS[name]()
    vector = random(problem, 2)
    own, follows = moves(problem.scene.layout)
    expected = np.where(problem.scene.layout.leader < 0, vector, follows @ vector[own])
    problem.tie(vector)
    np.testing.assert_allclose(vector, expected, rtol=1e-15, atol=1e-15)


@pytest.mark.parametrize("name", DRIVEN)
def test_a_prescribed_move_takes_along_all_that_is_led(name):
    problem = DRIVEN[name]()
    layout, move = problem.scene.layout, np.zeros(problem.scene.layout.leader.size)
    problem.lead(MOVE, move)
    own, follows = moves(layout)
    assert own[-1] == layout.driven
    np.testing.assert_allclose(move, MOVE * follows[:, -1], rtol=1e-15)
    assert np.count_nonzero(move) >= 1
    assert (np.count_nonzero(move) == 1) == (name in LOOSE)


def test_prescribed_moves_have_different_ratios():
    """Else nothing above holds the ratio."""
    assert {-1.0, 0.4, 1.0} <= set(prescribed().scene.layout.ratio)
