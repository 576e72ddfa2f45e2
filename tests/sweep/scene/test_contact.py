"""Parts of a scene that may touch: walls, and nodes with platens."""

import numpy as np
import pytest

from kernels.planar import neighbour_lists
from kernels.shared.moves import MOVE_MARGIN
from sweep.config.case import Case
from sweep.scene.contact import PAIRS
from sweep.scene.lattice import build_scene
from tests.studies.verify import MATERIAL
from tests.support.designs.grids import DEPTH, LOADINGS, THICKNESS, WALL, scene_of


def test_stiffness_of_contact_is_c_times_that_of_a_wall():
    touch = scene_of(contact=dict(stiffness=2.5)).terms.contact
    assert touch.stiffness == pytest.approx(2.5 * MATERIAL.modulus * DEPTH)
    assert touch.reach == THICKNESS
    np.testing.assert_allclose(touch.node_thickness, THICKNESS, rtol=1e-12)
    assert touch.tributary.sum() == pytest.approx(24 * WALL)


@pytest.mark.parametrize("model", ["none", "barrier"])
@pytest.mark.parametrize("platen", LOADINGS)
def test_platens_touch_what_is_not_glued_to_them(platen, model):
    scene = scene_of(platen=platen, contact=dict(model=model))
    y = scene.mesh.points[:, 1]
    touched = np.full(len(y), platen.endswith("contact"))
    if platen.endswith("glued") and model == "barrier":
        touched = (y > 0.0) & (y < 12.5e-3)
    np.testing.assert_array_equal(scene.terms.contact.platen_nodes, np.flatnonzero(touched))
    assert len(scene.terms.contact.edges) == (0 if model == "none" else len(scene.mesh.edges))
    np.testing.assert_allclose(
        scene.x_rest[-2:], [-0.5 * THICKNESS, 12.5e-3 + 0.5 * THICKNESS], rtol=1e-12
    )


def test_platens_touch_an_outline():
    lattice = dict(solid_layers=6)
    scene = build_scene(Case.of(lattice=lattice, loading=dict(force=1.0, platen="contact")))
    thickness = scene.terms.contact.node_thickness[scene.mesh.points[:, 1] == 0.0].max()
    assert 0.8e-3 < thickness < 1.2001e-3
    assert scene.x_rest[-2] == pytest.approx(-0.5 * thickness)


@pytest.mark.parametrize("kind", ["square", "circle"])
def test_lists_of_neighbours_do_not_grow_with_the_square_of_a_lattice(kind):
    lattice = dict(kind=kind, cells_x=24, cells_y=12, wall_thickness=5e-5, nodes_per_wall=1)
    scene = build_scene(Case.of(lattice=lattice))
    touch = scene.terms.contact
    pairs, margin, _ = neighbour_lists.list_neighbours(scene.terms, scene.x_rest, touch.most_move)
    assert margin == pytest.approx(MOVE_MARGIN * touch.most_move)
    assert 50 * len(scene.mesh.points) < pairs.node.size < PAIRS * len(scene.mesh.points)
    assert touch.most_move > 0.5 * 12.5e-3 / 24  # half a cell
