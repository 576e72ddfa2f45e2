"""Plates as a camera sees them: corners of quads on the screen, from back to front, and shades.

The view is orthographic, from above and aside, so that lengths along the screen's horizontal are
true and the cells are open to view.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from sweep.array_types import Floats, Ints

AZIMUTH, ELEVATION = np.radians(-62.0), np.radians(32.0)  # camera, from the x axis and up
LIGHT = np.array([-0.25, -0.65, 0.75])  # direction towards the light, left above the camera
LIGHT /= np.linalg.norm(LIGHT)
AMBIENT = 0.25  # shade of a face parallel to the light
COLOURS = ("#16283c", "#2b4c6f", "#7fa3c7", "#dfe9f3")  # of shades from 0 to 1


def _camera() -> Floats:
    """Directions to the right and up the screen, and towards the camera, (3, 3)."""
    low, high = (np.sin(ELEVATION), np.cos(ELEVATION))
    across = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
    toward = np.array([high * np.cos(AZIMUTH), high * np.sin(AZIMUTH), low])
    return np.stack([across, np.cross(toward, across), toward])


CAMERA = _camera()


class Faces(NamedTuple):
    """Quads from back to front: corners (m, 4, 2) on the screen and shades (m,) from 0 to 1."""

    corners: Floats
    shades: Floats


def seen(points: Floats) -> tuple[Floats, Floats]:
    """Points (..., 3) on the screen, (..., 2), and how near they are to the camera, (...)."""
    view = points @ CAMERA.T
    return view[..., :2], view[..., 2]


def faces(position: Floats, quads: Ints) -> Faces:
    """The faces of quads (m, 4) with nodes at ``position`` (n, 3); both sides are alike."""
    corner = np.asarray(position, float)[quads]
    screen, near = seen(corner)
    normal = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
    length = np.linalg.norm(normal, axis=1)
    lit = np.abs(normal @ LIGHT) / np.where(length > 0.0, length, 1.0)
    order = np.argsort(near.mean(axis=1), kind="stable")
    return Faces(screen[order], (AMBIENT + (1.0 - AMBIENT) * lit)[order])


def platen(box: Floats, height: float, margin: float) -> Floats:
    """Corners (4, 2) on the screen of the rectangle `ring` at a height."""
    return seen(np.column_stack([ring(box, margin), np.full(4, height)]))[0]


def ring(box: Floats, margin: float) -> Floats:
    """Corners (4, 2) of a rectangle; box: least and greatest x and y, (2, 2), widened by a margin.
    All in one unit of length.
    """
    (left, front), (right, back) = box[0] - margin, box[1] + margin
    return np.array([[left, front], [right, front], [right, back], [left, back]])


def cut_open(frames: Mapping[str, Any]) -> dict[str, Any]:
    """The shapes without the quads that lie in front of the middle at rest, as seen by the
    camera.
    """
    middle = np.asarray(frames["position_m"][0], float)[frames["quads"]].mean(axis=1)
    _, near = seen(middle * [1.0, 1.0, 0.0])
    behind = near <= 0.5 * (near.min() + near.max())
    return {**frames, **{name: frames[name][behind] for name in ("quads", "quad_thickness_m")}}
