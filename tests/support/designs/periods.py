"""Endless lattices for tests: a period of one, pressed, and what its unknowns lead."""

from unittest.mock import patch

import numpy as np

from sweep.config.case import Case
from sweep.design import period
from sweep.design.drawing import welded
from tests.support.designs.tables import lattice_with, material_with

Y, NU, L, DEPTH = 12e6, 0.48, 4e-3, 10e-3
PLANE = Y / (1 - NU**2)
MATERIAL = material_with(modulus=Y, density=1e3, poisson=NU)
PITCH = {"hex": (0.6 * 3**0.5, 0.9), "kagome": (1.0, 0.75**0.5)}


def lattice_of(kind, cells, slenderness, **chosen):
    pitch = PITCH.get(kind, (1.0, 1.0))
    width, height = (L * n * length for n, length in zip(cells, pitch, strict=True))
    return lattice_with(
        kind=kind, boundary="periodic", cells_x=cells[0], cells_y=cells[1], width=width,
        height=height, depth=DEPTH, wall_thickness=slenderness * L, **chosen,
    )  # fmt: skip


def pressed(lattice, strain=0.6, steps=60, friction=0.0, model="barrier", unload=False):
    return Case.of(
        lattice=lattice,
        material=MATERIAL,
        loading=dict(mode="displacement", strain=strain, unload=unload),
        contact=dict(model=model, friction=friction),
        solver=dict(load_steps=steps, joints="points"),
    )


def follow(scene):
    """Matrix (n, free + 1) from what is free, and the height of the period, to all coordinates."""
    leader, images, driven = (
        getattr(scene.terms.layout, name) for name in ("leader", "images", "driven")
    )
    free = np.setdiff1d(leader[leader >= 0], [*images[:, 0], driven])
    follows = (leader[:, None] == [*free, driven]).astype(float)
    for c, of, mean, times in images:
        follows[c] = times * follows[mean] + (follows[of] if of >= 0 else 0.0)
    return follows


def cut_elsewhere(cut):
    """Patch that puts the lower left corner of the period at ``cut``, m."""

    def moved(segments, tolerance):
        return welded(segments - np.array(cut), tolerance)

    return patch.object(period, "welded", moved)
