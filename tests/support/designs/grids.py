"""Scenes of a 3 x 3 grid, 12.5 mm over centre lines, under every loading."""

import numpy as np

from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from tests.support.designs.tables import MATERIAL

DEPTH, THICKNESS, WALL = 12e-3, 0.8e-3, 12.5e-3 / 3
LOADINGS = {
    "none": dict(force=5.0),
    "contact": dict(force=5.0, platen="contact"),
    "glued": dict(force=5.0, platen="glued"),
    "driven, contact": dict(mode="displacement", platen="contact"),
    "driven, glued": dict(mode="displacement", platen="glued"),
}


def scene_of(elements=3, platen="none", imperfection=0.0, **tables):
    """A 3 x 3 grid of a linear material in plane stress, with joints that are points."""
    lattice = dict(nodes_per_wall=elements - 1, imperfection=imperfection)
    chosen = {"lattice": lattice, "material": MATERIAL, "loading": LOADINGS[platen]}
    chosen |= {"solver": dict(joints="points")} | tables
    return build_scene(Case.of(**chosen))


def row_of_nodes(scene, height):
    """x, y and rotation coordinates of an outer row."""
    nodes = np.flatnonzero(np.isclose(scene.mesh.points[:, 1], height))
    return 2 * nodes, 2 * nodes + 1, 2 * len(scene.mesh.points) + nodes
