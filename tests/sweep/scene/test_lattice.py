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
    loading = dict(mode="displacement", strain=0.2, unload=False)
    tables = dict(lattice=dict(nodes_per_wall=2), material=MATERIAL, solver=dict(load_steps=10))
    result = simulate(Case.of(loading=loading, **tables))
    moved = result.frames["position_m"] - result.frames["position_m"][0]
    rest = result.frames["position_m"][0]
    top, bottom = (np.isclose(rest[:, 1], y) for y in (12.5e-3, 0.0))
    assert top.sum() == bottom.sum() == 10
    assert not moved[:, bottom].any()
    down = np.outer(-12.5e-3 * result.frames["strain"], np.ones(10))
    np.testing.assert_allclose(moved[:, top, 0], 0.0, atol=1e-15)
    np.testing.assert_allclose(moved[:, top, 1], down, atol=1e-15)
    assert np.abs(moved[-1, :, 0]).max() > 1e-4


@pytest.mark.parametrize(
    ("platen", "bottom", "top", "base"),
    [
        ("none", "row", "upper row", "row"),
        ("glued", "both", "upper row", "row"),
        ("contact", "platen", "nothing", "nodes"),
        ("driven, contact", "platen", "upper platen", "platen"),
        ("driven, glued", "both", "upper platen", "platen"),
    ],
)
def test_where_reaction_and_strain_are_read(platen, bottom, top, base):
    scene = scene_of(platen=platen)
    nodes, high = 2 * len(scene.mesh.points), scene.x_rest.size - 1
    below, above = (row_of_nodes(scene, y)[1] for y in (0.0, 12.5e-3))
    of = {"row": below, "platen": [high - 1], "both": [*below, high - 1]}
    of |= {"upper row": above, "upper platen": [high], "nothing": []}
    of |= {"nodes": np.arange(1, nodes, 2)}
    for coordinates, name in ((scene.bottom, bottom), (scene.top, top), (scene.base, base)):
        np.testing.assert_array_equal(coordinates, of[name])
