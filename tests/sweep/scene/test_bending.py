"""Walls and joints of a case: chains of elements, stiffness of hinges, arms and folds."""

import numpy as np
import pytest

from sweep.config.case import Case, Lattice, Loading, Solver
from sweep.scene.lattice import build_scene
from tests.studies.verify import MATERIAL
from tests.support.solving import whole

DEPTH, THICKNESS, WALL = 12e-3, 0.8e-3, 12.5e-3 / 3
RIGIDITY = MATERIAL.modulus * DEPTH * THICKNESS**3 / 12


def scene_of(elements=3, imperfection=0.0, solver=None):
    """A 3 x 3 grid of a linear material in plane stress."""
    return build_scene(
        Case(
            lattice=Lattice(nodes_per_wall=elements - 1, imperfection=imperfection),
            material=MATERIAL,
            loading=Loading(force=5.0),
            solver=Solver() if solver is None else solver,
        )
    )


@pytest.mark.parametrize("elements", [1, 2, 3, 7])
@pytest.mark.parametrize("hinges", ["exact_beam", "classical"])
def test_hinge_stiffness(hinges, elements):
    bend = scene_of(elements, solver=Solver(hinges=hinges)).terms.bend
    n, per_length = elements, RIGIDITY / (WALL / elements)
    inside, at_end = {
        "exact_beam": (per_length * (1 - 1 / n**2), 2 * per_length * (1 + 1 / n)),
        "classical": (per_length, 2 * per_length),
    }[hinges]
    assert bend.hinge_stiffness.shape == (24 * (n - 1),)
    np.testing.assert_allclose(bend.hinge_stiffness, inside, rtol=1e-12)
    np.testing.assert_allclose(bend.arm_stiffness, np.full(48, at_end), rtol=1e-12)


@pytest.mark.parametrize(
    ("hinges", "elements", "count"),
    [("exact_beam", 1, 24), ("exact_beam", 2, 0), ("classical", 1, 0)],
)
def test_only_an_exact_single_element_couples_its_ends(hinges, elements, count):
    """E = 2 YI/h (a1^2 + a1 a2 + a2^2): k12 is half of k1 = k2 = 4 YI/h."""
    bend = scene_of(elements, solver=Solver(hinges=hinges)).terms.bend
    assert np.count_nonzero(bend.coupling) == count
    np.testing.assert_allclose(bend.coupling, np.full(24, 2 * RIGIDITY / WALL if count else 0.0))


@pytest.mark.parametrize("measure", ["angle", "tangent"])
@pytest.mark.parametrize("imperfection", [0.0, 0.5])
def test_arms_and_hinges_are_free_of_stress_at_rest(imperfection, measure):
    scene = scene_of(4, imperfection=imperfection, solver=Solver(bend_measure=measure))
    assert scene.terms.bend.measure == {"angle": 0, "tangent": 1}[measure]
    g = whole(scene, scene.x_rest).gradient(scene.x_rest)
    np.testing.assert_allclose(g, -scene.terms.coordinates.load, rtol=0, atol=1e-9)


def test_folds_of_a_grid():
    """Openings round every joint: of corners by 90 and 270 degrees, of walls in line by 180."""
    scene = scene_of(3)
    fold, bend = scene.terms.fold, scene.terms.bend
    assert len(fold.nodes) == 4 * 2 + 8 * 3 + 4 * 4
    assert np.all(fold.nodes[:, 1] < scene.mesh.n_joints)
    np.testing.assert_allclose(fold.limit, np.radians(20.0))
    arm = bend.arm_stiffness[0]
    quarters = np.round(np.sqrt(fold.stiffness / (0.5 * arm)) / (np.pi / 4), 9)
    found, count = np.unique(quarters, return_counts=True)
    np.testing.assert_allclose(found, [1.0, 2.0, 3.0])
    assert list(count) == [4 + 16 + 16, 8, 4]


@pytest.mark.parametrize("imperfection", [0.0, 2.0])
@pytest.mark.parametrize("elements", [1, 3])
def test_walls_are_chains_from_joint_to_joint(elements, imperfection):
    """Hinges inside them, with the angles that they have at rest; an arm at either end."""
    scene = scene_of(elements, imperfection=imperfection)
    walls, bend, mesh = scene.terms.walls, scene.terms.bend, scene.mesh
    np.testing.assert_array_equal(walls.start, elements * np.arange(25))
    first, last = walls.edges[walls.start[:-1]], walls.edges[walls.start[1:] - 1]
    np.testing.assert_array_equal(walls.arm_element[::2], walls.start[:-1])
    np.testing.assert_array_equal(walls.arm_element[1::2], walls.start[1:] - 1)
    joints = np.column_stack([first[:, 0], last[:, 1]]).ravel()
    assert np.all(joints < mesh.n_joints)
    np.testing.assert_array_equal(walls.rotation, 2 * len(mesh.points) + joints)
    inside = np.setdiff1d(np.arange(24 * elements), walls.start[1:] - 1)
    np.testing.assert_array_equal(bend.hinges, inside)
    np.testing.assert_array_equal(walls.edges[inside, 1], walls.edges[inside + 1, 0])
    along = mesh.points[walls.edges[:, 1]] - mesh.points[walls.edges[:, 0]]
    bearing = np.arctan2(along[:, 1], along[:, 0])
    np.testing.assert_allclose(
        bend.hinge_angle, bearing[inside + 1] - bearing[inside], rtol=0, atol=1e-12
    )
    assert np.any(np.abs(bend.hinge_angle) > 1e-3) == (imperfection > 0.0 and elements > 1)
    arms = bearing[walls.arm_element]
    np.testing.assert_allclose(
        bend.arm_rest, np.column_stack([np.cos(arms), np.sin(arms)]), rtol=0, atol=1e-15
    )
