"""Nets of a period of a panel and of a block: boxes of a level surface, as `names` lays them."""

from functools import lru_cache

import numpy as np

from sweep.array_types import Floats
from sweep.design.surfaces.level_set import LEVEL_SETS
from sweep.design.surfaces.names import SHEETS
from sweep.design.surfaces.nets import Box, Net, best_net

DIAGONAL = np.array([[1.0, -1.0, 0.0], [0.0, 0.0, np.sqrt(2.0)], [1.0, 1.0, 0.0]]) / np.sqrt(2.0)
"""Axes x, y, z of a turned box, in the axes of the surface, row by row."""


@lru_cache(maxsize=16)
def net_of(name: str, turned: bool, period: float, height: float, quads: int) -> Net:
    """The net of a sheet of `names.SHEETS`, with ``quads`` per period.

    turned: see `SheetName.cut`. period, height: m. The sheet is pressed along z of the net.
    """
    cut = SHEETS[name].cut(turned)
    size = np.array([cut.across * period, cut.along * period, height])
    axes = DIAGONAL if turned else np.eye(3)
    phase = 2.0 * np.pi / period * axes.T
    box = Box(LEVEL_SETS[name], size, phase, phase[:, 2] * cut.start * period)
    return best_net(box, period, quads)


@lru_cache(maxsize=4)
def net_of_block(
    name: str, period: float, size: tuple[float, float, float], walls: tuple[int, int], quads: int
) -> Net:
    """The net of a block, with ``quads`` per period, with walls across two axes.

    period, size: m; the sheet is pressed along z of the net.
    """
    phase = 2.0 * np.pi / period * np.eye(3)
    origin = 2.0 * np.pi * np.array(SHEETS[name].corner)
    box = Box(LEVEL_SETS[name], np.array(size), phase, origin, walls)
    return best_net(box, period, quads)


def printed_thickness(line: float, layer: float, normals: Floats, along: bool) -> Floats:
    """Thickness (n,) of a sheet that is printed as lines in layers, m.

    line, layer: thickness of the lines and height of the layers, m. normals (n, 3): unit normals in
    the axes of a net, across whose z the layers lie if it is pressed ``along`` the print axis, else
    across y. It is line |n_xy|, n_xy in the plane of the layers, and at least a layer.
    """
    upward = normals[:, 2 if along else 1]
    return np.maximum(line * np.sqrt(1.0 - upward**2), layer)
