"""The network of a user's drawing."""

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.design.drawing import connected, outer_rows
from sweep.design.geometry import Drawing
from sweep.design.network import Network

BENT = 15.0  # degrees: two walls that meet at a smaller angle are one bent wall


def build_drawn(drawing: Drawing, thickness: float) -> Network:
    """The walls of a drawing, of a mean thickness in m."""
    points, walls = np.array(drawing.joints), np.array(drawing.walls)
    share = np.array(drawing.shares) if drawing.shares else np.ones(len(walls))
    part = _part(points, walls, share)
    return Network(points, walls, thickness * share, *outer_rows(points), part=part)


def loose_ends(network: Network) -> Ints:
    """Joints at which one wall ends, between the lowest and the highest row, (k,)."""
    alone = np.flatnonzero(np.bincount(network.walls.ravel()) == 1)
    return np.setdiff1d(alone, np.union1d(network.bottom, network.top))


def _part(points: Floats, walls: Ints, share: Floats) -> Floats:
    """Length of every wall over the length of its smooth line, (w,), as in `Network.part`.

    In a smooth line walls meet in pairs, are equally thick, and turn by less than `BENT`.
    """
    order = np.argsort(walls.ravel(), kind="stable")
    joint = walls.ravel()[order]
    two = np.flatnonzero(np.bincount(joint) == 2)
    first = order[np.searchsorted(joint, two)]
    second = order[np.searchsorted(joint, two) + 1]
    away = points[walls[:, ::-1].ravel()] - points[walls.ravel()]
    length = np.linalg.norm(away, axis=1)
    cosine = -np.einsum("ij,ij->i", away[first], away[second]) / (length[first] * length[second])
    smooth = (cosine > np.cos(np.radians(BENT))) & (share[first // 2] == share[second // 2])
    line = connected(np.column_stack([first, second])[smooth] // 2, len(walls))
    of_wall = length[::2]
    return np.asarray(of_wall / np.bincount(line, of_wall)[line])
