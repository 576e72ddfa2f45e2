"""Coordinates: their order, which of them are held, and which lead the others."""

import numpy as np
import pytest

from tests.support.designs.grids import LOADINGS, row_of_nodes, scene_of


@pytest.mark.parametrize("elements", [1, 3])
@pytest.mark.parametrize("platen", LOADINGS)
def test_what_is_held_and_what_moves_with_the_platen(platen, elements):
    """A clamped row is held in x, y and phi; a glued upper one too, except in y, the platen's."""
    scene = scene_of(elements, platen)
    leader = scene.terms.layout.leader
    low, high = leader.size - 2, leader.size - 1
    bottom, top = (np.concatenate(row_of_nodes(scene, y)) for y in (0.0, 12.5e-3))
    x, y, rotation = row_of_nodes(scene, 12.5e-3)
    glued = np.concatenate([x, rotation])
    held, led = {
        "none": ([*bottom, low, high], []),
        "glued": ([*bottom, *glued, low], [*y, high]),
        "contact": ([low], [high]),
    }[platen.removeprefix("driven, ")]
    np.testing.assert_array_equal(np.flatnonzero(leader < 0), np.sort(held))
    np.testing.assert_array_equal(np.flatnonzero(leader == high), np.sort(led))
    alone = np.delete(np.arange(leader.size), [*held, *led])
    np.testing.assert_array_equal(leader[alone], alone)
    assert scene.terms.coordinates.driven == (high if platen.startswith("driven") else -1)
    assert len(top) == len(bottom)
