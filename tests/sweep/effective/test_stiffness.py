"""Effective stiffness against closed forms (Gibson & Ashby 1997) and against the engine."""

from math import sqrt

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.faults import MisfitError
from sweep.effective.cell import frame_of, infill_of
from sweep.effective.stiffness import coordinates, element_stiffness, response, sheared
from sweep.simulation.simulate import simulate
from tests.support.designs.slender import DEPTH, MODULUS, PERIODS, slender

RATIO = 0.01
BENT, STRETCHED = RATIO**3, RATIO
CLOSED = {  # modulus along 1 and 2, shear modulus, Poisson's ratio; over the modulus of the walls
    "square": (STRETCHED, 0.5 * BENT, 0.0),
    "hex": (4 / sqrt(3) * BENT, BENT / sqrt(3), 1.0),
    "triangle": (2 / sqrt(3) * STRETCHED, sqrt(3) / 4 * STRETCHED, 1 / 3),
    "kagome": (STRETCHED / sqrt(3), sqrt(3) / 8 * STRETCHED, 1 / 3),
}


@pytest.mark.parametrize("kind", CLOSED)
def test_slender_walls_follow_the_closed_forms(kind):
    stiffness, _ = response(frame_of(infill_of(slender(kind, RATIO))))
    compliance = np.linalg.inv(stiffness / DEPTH)
    modulus, shear, poisson = CLOSED[kind]
    assert 1 / compliance[0, 0] == pytest.approx(modulus * MODULUS, rel=1e-3)
    assert 1 / compliance[1, 1] == pytest.approx(modulus * MODULUS, rel=1e-3)
    assert 1 / compliance[2, 2] == pytest.approx(shear * MODULUS, rel=1e-3)
    assert -compliance[0, 1] / compliance[0, 0] == pytest.approx(poisson, rel=1e-3, abs=1e-9)
    assert np.abs(compliance[2, :2]).max() < 1e-6 * compliance[2, 2]


def test_walls_much_deeper_than_thick_are_in_plane_strain():
    thin, deep = (
        response(frame_of(infill_of(slender("hex", plane=plane))))[0]
        for plane in ("stress", "strain")
    )
    ratio = np.linalg.inv(thin)[1, 1] / np.linalg.inv(deep)[1, 1]
    assert ratio == pytest.approx(1 / (1 - 0.3**2), rel=1e-3)


@pytest.mark.parametrize("kind", ["square", "hex", "reentrant", "kagome", "circle"])
def test_a_crush_of_the_engine_begins_with_this_modulus(kind):
    """Stocky walls that shear, with solid joints, of a linear material."""
    pitch = {"hex": (3**0.5, 1.5), "kagome": (2.0, 3**0.5)}.get(kind, (1.0, 1.0))
    size = {"width": 16e-3 * pitch[0], "height": 16e-3 * pitch[1], "cells_x": 2, "cells_y": 2}
    walls = {"kind": kind, "wall_thickness": 1.2e-3, "imperfection": 0.0}
    case = Case.of(
        lattice=size | walls | {"boundary": "periodic"},
        material={"modulus": 12e6, "density": 1200.0},
        loading={"mode": "displacement", "strain": 1e-5, "unload": False},
    )
    assert case.solver.joints == "solid"
    result = simulate(case)
    area = result.summary["width_m"] * result.summary["depth_m"]
    modulus = result.history["reaction_top_N"][-1] / area / 1e-5
    stiffness, _ = response(frame_of(infill_of(case)))
    compliance = np.linalg.inv(stiffness / case.lattice.depth)
    assert 1.0 / compliance[1, 1] == pytest.approx(modulus, rel=1e-3)


def test_rigid_motions_cost_nothing():
    frame = frame_of(infill_of(slender("hex")))
    own = element_stiffness(frame)
    moved = np.zeros((len(own), 6, 3))
    moved[:, [0, 3], 0] = moved[:, [1, 4], 1] = 1.0
    ends = np.einsum("m,mi->mi", frame.length, frame.along)
    moved[:, 3, 2], moved[:, 4, 2], moved[:, [2, 5], 2] = -ends[:, 1], ends[:, 0], 1.0
    forces = np.einsum("mij,mjk->mik", own, moved)
    assert np.abs(forces).max() < 1e-9 * np.abs(own).max() * np.abs(ends).max()
    assert coordinates(frame).max() == 3 * frame.nodes - 1


@pytest.mark.parametrize("kind", PERIODS)
def test_out_of_the_plane_half_of_thin_walls_is_sheared(kind):
    """G / G of the walls is half of the relative density of a pattern that is alike in x and y."""
    frame = frame_of(infill_of(slender(kind, RATIO)))
    filled = frame.length @ frame.thickness / frame.area
    np.testing.assert_allclose(sheared(frame, 1.0), 0.5 * filled * np.eye(2), rtol=1e-9, atol=1e-9)


def test_a_mechanism_is_refused():
    """Squares of walls with hinges at all joints shear without a force."""
    frame = frame_of(infill_of(slender("square")))
    hinged = frame._replace(bending=0.0 * frame.bending)
    with pytest.raises(MisfitError, match="a mechanism"):
        response(hinged)
