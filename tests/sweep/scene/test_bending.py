"""Walls of a case: chains of elements, their stiffness, and folds."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from tests.studies.verify import MATERIAL
from tests.support.converged import converged
from tests.support.designs.tables import material_with
from tests.support.kernels.solving import whole

DEPTH, THICKNESS, WALL = 12e-3, 0.8e-3, 12.5e-3 / 3
LOOSE = dict(mode="displacement", strain=0.6, platen="contact", unload=False)
RIGIDITY = MATERIAL.modulus * DEPTH * THICKNESS**3 / 12


def scene_of(elements=3, imperfection=0.0, solver=None):
    """A 3 x 3 grid of a linear material in plane stress, with joints that are points."""
    return build_scene(
        Case.of(
            lattice=dict(nodes_per_wall=elements - 1, imperfection=imperfection),
            material=MATERIAL,
            loading=dict(force=5.0),
            solver=dict(joints="points") if solver is None else solver,
        )
    )


@pytest.mark.parametrize("elements", [1, 3, 7])
@pytest.mark.parametrize(
    ("element", "factors", "arc"),
    [("cubic", (4.0, 2.0, 4.0), (1 / 15, -1 / 30)), ("classical", (2.0, 0.0, 2.0), (0.0, 0.0))],
)
def test_stiffness_of_elements(element, factors, arc, elements):
    terms = scene_of(elements, solver=dict(element=element, joints="points")).terms
    per_length, every = RIGIDITY / (WALL / elements), np.ones(24 * elements)
    np.testing.assert_allclose(
        terms.bend.stiffness, np.outer(factors, per_length * every), rtol=1e-12
    )
    np.testing.assert_allclose(terms.stretch.arc, np.outer(arc, every), rtol=1e-15)


def test_a_half_turn_is_shared_inside_walls_only():
    scene = scene_of(3)
    at_joint = scene.mesh.n_joints > scene.mesh.edges.T
    np.testing.assert_array_equal(scene.terms.bend.side, np.where(at_joint, 2.0, 1.0))


def test_walls_without_bending_have_neither_rotations_nor_arcs():
    material = material_with(modulus=12e6, density=1190.0, bend="none")
    case = Case.of(material=material, loading=dict(force=5.0))
    terms = build_scene(case).terms
    assert not terms.bend.stiffness.any()
    assert not terms.stretch.arc.any()
    assert np.all(terms.layout.leader[terms.walls.dofs[:, [2, 5]]] == -1)


@pytest.mark.parametrize("measure", ["angle", "tangent"])
def test_walls_without_bending_fold(measure):
    """Elements turn by more than the 90 degrees at which the measure "tangent" is infinite."""
    case = Case.of(
        material=MATERIAL.model_copy(update={"bend": "none"}),
        loading=dict(force=13.0, duration=0.03),
        contact=dict(model="none"),
        damping=dict(model="rayleigh", stiffness=1e-4),
        solver=dict(element="classical", bend_measure=measure),
    )
    result = converged(case)
    last, top = result.frames["position_m"][-1], result.history["top_displacement_m"][-1]
    assert abs(result.summary["energy_residual_J"]) < 1e-6 * result.summary["absorbed_energy_J"]
    assert top > 2.0 * case.lattice.height
    assert last[:, 1].min() < -case.lattice.height


@pytest.mark.parametrize("measure", ["angle", "tangent"])
@pytest.mark.parametrize("imperfection", [0.0, 0.5])
def test_elements_are_free_of_stress_at_rest(imperfection, measure):
    scene = scene_of(
        4, imperfection=imperfection, solver=dict(bend_measure=measure, joints="points")
    )
    assert scene.terms.bend.measure == {"angle": 0, "tangent": 1}[measure]
    g = whole(scene, scene.x_rest).gradient(scene.x_rest)
    np.testing.assert_allclose(g, -scene.terms.coordinates.load, rtol=0, atol=1e-9)


def test_folds_of_a_grid():
    """Openings round every joint: of corners by 90 and 270 degrees, of walls in line by 180; on
    both sides of every node inside a wall.
    """
    scene = scene_of(3)
    fold, inside = scene.terms.fold, 2 * 24
    assert len(fold.nodes) == 4 * 2 + 8 * 3 + 4 * 4 + 2 * inside
    np.testing.assert_allclose(fold.limit, np.radians(20.0))
    hinge = RIGIDITY / (WALL / 3)
    quarters = np.round(np.sqrt(fold.stiffness / hinge) / (np.pi / 4), 9)
    found, count = np.unique(quarters, return_counts=True)
    np.testing.assert_allclose(found, [1.0, 2.0, 3.0])
    assert list(count) == [4 + 16 + 16, 8 + 2 * inside, 4]


@pytest.mark.parametrize("imperfection", [0.0, 2.0])
@pytest.mark.parametrize("elements", [1, 3])
def test_walls_are_chains_from_joint_to_joint(elements, imperfection):
    scene = scene_of(elements, imperfection=imperfection)
    walls, mesh = scene.terms.walls, scene.mesh
    np.testing.assert_array_equal(walls.start, elements * np.arange(25))
    first, last = walls.edges[walls.start[:-1]], walls.edges[walls.start[1:] - 1]
    assert np.all(np.column_stack([first[:, 0], last[:, 1]]) < mesh.n_joints)
    inside = np.setdiff1d(np.arange(24 * elements), walls.start[1:] - 1)
    np.testing.assert_array_equal(walls.edges[inside, 1], walls.edges[inside + 1, 0])
    turns = 2 * len(mesh.points) + walls.edges
    expected = np.stack([2 * walls.edges, 2 * walls.edges + 1, turns], axis=-1)
    np.testing.assert_array_equal(walls.dofs, expected.reshape(-1, 6))
    along = mesh.points[walls.edges[:, 1]] - mesh.points[walls.edges[:, 0]]
    np.testing.assert_allclose(walls.rest, along / mesh.rest_length[:, None], rtol=1e-14)
    assert np.any(np.ptp(walls.rest.reshape(24, -1, 2), axis=1) > 1e-3) == (
        imperfection > 0.0 and elements > 1
    )


def test_what_full_joints_leave_of_a_wall_bends_linearly():
    """Circles of 2 g: their joints overlap, and the stubs between them are no beams."""
    lattice = dict(kind="circle", width=20e-3, height=20e-3, mass=2e-3)
    case = Case.of(lattice=lattice, material={}, loading=LOOSE)
    scene = build_scene(case)
    bent = scene.terms.bend.volume > 0.0
    stubs, short = scene.mesh.stubs, scene.mesh.rest_length < 0.5 * scene.mesh.thickness
    assert stubs.any()
    assert bent.any()
    np.testing.assert_array_equal(bent, ~short & (scene.mesh.joint < 0))
    np.testing.assert_array_equal(stubs, short & (scene.mesh.joint < 0))


def test_such_a_lattice_reaches_the_end_of_its_crush():
    """Its stubs once bent as if they had fibres, by many radians."""
    lattice = dict(kind="circle", width=20e-3, height=20e-3, mass=2e-3)
    assert converged(Case.of(lattice=lattice, material={}, loading=LOOSE))


def test_short_elements_of_a_fine_mesh_are_no_stubs():
    fine = scene_of(24, solver=dict(joints="points")).mesh
    assert np.all(fine.rest_length < 0.5 * fine.thickness)
    assert not fine.stubs.any()
