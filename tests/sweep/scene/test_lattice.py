"""A lattice between platens: its loads, its motion with them, and where it is measured."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.studies.verify import MATERIAL
from tests.support.designs.grids import LOADINGS, row_of_nodes, scene_of


@pytest.mark.parametrize("elements", [1, 3])
@pytest.mark.parametrize("platen", LOADINGS)
def test_the_load_sums_to_the_force(platen, elements):
    scene = scene_of(elements, platen)
    load, nodes = scene.terms.coordinates.load, 2 * len(scene.mesh.points)
    if platen.startswith("driven"):
        assert not load.any()
    elif platen == "none":
        top = np.flatnonzero(np.isclose(scene.mesh.points[:, 1], 12.5e-3))
        assert len(top) == 3 * elements + 1
        np.testing.assert_allclose(load[2 * top + 1], -5.0 / len(top), rtol=1e-12)
        assert np.count_nonzero(load) == len(top)
    else:
        assert load[-1] == -5.0
        assert not load[:-1].any()
    assert load.sum() == (0.0 if platen.startswith("driven") else pytest.approx(-5.0, rel=1e-12))
    assert not load[:nodes:2].any()


def test_a_glued_row_keeps_its_shape():
    """Through a whole crush its nodes stay side by side and go down with the platen."""
    result = simulate(
        Case.of(
            material=MATERIAL,
            loading=dict(mode="displacement", strain=0.2, unload=False),
            solver=dict(load_steps=10),
        )
    )
    shapes, rest = result.frames["position_m"], result.frames["position_m"][0]
    top, bottom = (np.isclose(rest[:, 1], y) for y in (12.5e-3, 0.0))
    assert top.sum() == bottom.sum() == 10
    np.testing.assert_allclose(
        shapes[:, bottom], np.broadcast_to(rest[bottom], shapes[:, bottom].shape)
    )
    moved = shapes[:, top] - rest[top]
    np.testing.assert_allclose(moved[:, :, 0], 0.0, atol=1e-15)
    np.testing.assert_allclose(
        moved[:, :, 1],
        -12.5e-3 * result.frames["strain"][:, None] + 0.0 * moved[:, :, 1],
        atol=1e-15,
    )
    assert np.abs(shapes[-1] - rest)[:, 0].max() > 1e-4


@pytest.mark.parametrize(
    ("platen", "bottom", "top", "base"),
    [
        ("none", "row", "row", "row"),
        ("glued", "row and platen", "row", "row"),
        ("contact", "platen", "nothing", "nodes"),
        ("driven, contact", "platen", "platen", "platen"),
        ("driven, glued", "row and platen", "platen", "platen"),
    ],
)
def test_where_reaction_and_strain_are_read(platen, bottom, top, base):
    scene = scene_of(platen=platen)
    high = scene.x_rest.size - 1
    below, above = row_of_nodes(scene, 0.0)[1], row_of_nodes(scene, 12.5e-3)[1]
    nodes = 2 * np.arange(len(scene.mesh.points)) + 1
    low_of = {"row": below, "platen": [high - 1], "nodes": nodes}
    low_of["row and platen"] = [*below, high - 1]
    high_of = {"row": above, "platen": [high], "nothing": []}
    np.testing.assert_array_equal(scene.bottom, low_of[bottom])
    np.testing.assert_array_equal(scene.top, high_of[top])
    np.testing.assert_array_equal(scene.base, low_of[base])
