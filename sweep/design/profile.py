"""Rigid profiles that press a lattice, or carry it: chains of straight lines, rounded by a radius.

All lengths in m. A chain is convex and open; the region it encloses is on its left
(`kernels.geometry.profile`). A profile that moves has its tip at y = 0 and lies above it.
"""

from math import cos, sin
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats

ARC = np.deg2rad(5.0)  # turn between points of a drawn round part


class Profile(NamedTuple):
    """chain (v, 2), radius, and the vertices that are a tip or a corner, (t,)."""

    chain: Floats
    radius: float
    tips: tuple[int, ...]

    def outline(self) -> Floats:
        """The outline as a polygon (k, 2), for pictures."""
        turns = np.arange(0.0, 2.0 * np.pi, ARC)
        disc = self.radius * np.column_stack([np.cos(turns), np.sin(turns)])
        return hull((self.chain[:, None] + disc).reshape(-1, 2))

    def upside_down(self) -> "Profile":
        """The profile below its tip, to carry a lattice."""
        return self._replace(chain=self.chain * [1.0, -1.0])


def circle(x: float, radius: float) -> Profile:
    """A cylinder across the depth, with its axis at ``x``."""
    return Profile(np.array([[x, radius]]), radius, (0,))


def wedge(x: float, angle: float, tip: float, reach: float) -> Profile:
    """An edge of the included ``angle`` (rad), rounded by ``tip``; flanks as long as ``reach``."""
    side = [reach * sin(0.5 * angle), reach * cos(0.5 * angle)]
    return _above([[-side[0], side[1]], [0.0, 0.0], side], x, tip, (1,))


def punch(x: float, width: float, tip: float, reach: float) -> Profile:
    """A flat face of ``width`` with corners rounded by ``tip``; flanks as long as ``reach``."""
    half = 0.5 * width - tip
    chain = [[-half, reach], [-half, 0.0], [half, 0.0], [half, reach]]
    return _above(chain, x, tip, (1, 2))


def _above(chain: list[list[float]], x: float, radius: float, tips: tuple[int, ...]) -> Profile:
    """A profile at ``x`` whose chain is a radius above its tip."""
    return Profile(np.array(chain) + np.array([x, radius]), radius, tips)


def rib(x: float, radius: float, reach: float) -> Profile:
    """A plate on edge, as thick as its round end is wide and as high as ``reach``, pointing down.

    Its chain is one line, which encloses nothing.
    """
    return Profile(np.array([[x, radius], [x, reach]]), radius, (0,)).upside_down()


def hull(points: Floats) -> Floats:
    """The corners of the convex hull of ``points`` (n, 2), anticlockwise from the leftmost one."""
    import shapely  # few sweeps need it

    whole = shapely.convex_hull(shapely.multipoints(points))
    clockwise = shapely.get_coordinates(shapely.normalize(whole))  # closed
    return clockwise[:0:-1]
