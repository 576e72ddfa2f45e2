"""Periodic functions whose zero levels are close to minimal surfaces.

    gyroid     sin x cos y + sin y cos z + sin z cos x
    schwarz_p  cos x + cos y + cos z                        (primitive)
    schwarz_d  cos x cos y cos z - sin x sin y sin z        (diamond)

each in phases of 2 pi a period (K. Michielsen and J. Kole, Phys. Rev. B 68, 2003). Slicers print
the first as "gyroid".
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats


class LevelSet(NamedTuple):
    """value: (n,) at phases (n, 3); gradient: (n, 3) at these phases."""

    value: Callable[[Floats], Floats]
    gradient: Callable[[Floats], Floats]


def _gyroid(p: Floats) -> Floats:
    s, c = np.sin(p), np.cos(p)
    return np.asarray((s * c[:, [1, 2, 0]]).sum(axis=1))


def _gyroid_gradient(p: Floats) -> Floats:
    s, c = np.sin(p), np.cos(p)
    return np.asarray(c * c[:, [1, 2, 0]] - s * s[:, [2, 0, 1]])


def _primitive(p: Floats) -> Floats:
    return np.asarray(np.cos(p).sum(axis=1))


def _primitive_gradient(p: Floats) -> Floats:
    return np.asarray(-np.sin(p))


def _diamond(p: Floats) -> Floats:
    return np.asarray(np.cos(p).prod(axis=1) - np.sin(p).prod(axis=1))


def _diamond_gradient(p: Floats) -> Floats:
    s, c = np.sin(p), np.cos(p)
    one, two = [1, 2, 0], [2, 0, 1]
    return np.asarray(-s * c[:, one] * c[:, two] - c * s[:, one] * s[:, two])


LEVEL_SETS = {
    "gyroid": LevelSet(_gyroid, _gyroid_gradient),
    "schwarz_p": LevelSet(_primitive, _primitive_gradient),
    "schwarz_d": LevelSet(_diamond, _diamond_gradient),
}
"""By the name in `lattice.kind`."""
