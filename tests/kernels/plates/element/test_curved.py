"""Benchmarks of curved shells.

The benchmarks and their numbers are due to R. MacNeal and R. Harder (Finite Elements in Analysis
and Design 1, 1985) and to T. Belytschko et al. (CMAME 51, 1985).
"""

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from tests.support.kernels import sheets
from tests.support.kernels.shells import (
    element_hessians,
    surface,
)


def solved(of, law, held, load):
    """Displacements (n, 6) under small loads; held, load: by coordinate (n, 6)."""
    blocks = element_hessians(of, of.rest, law)
    at = (6 * of.walls.quads[:, :, None] + np.arange(6)).reshape(len(blocks), 24)
    rows, columns = np.repeat(at, 24, axis=1).ravel(), np.tile(at, (1, 24)).ravel()
    n = 6 * len(of.points)
    stiffness = coo_matrix((blocks.ravel(), (rows, columns)), (n, n)).tocsr()
    free = np.flatnonzero(~held.ravel())
    move = np.zeros(n)
    move[free] = spsolve(stiffness[free][:, free], load.ravel()[free])
    return move.reshape(-1, 6)


def mirrored(of, on, axis):
    """Coordinates of the nodes ``on`` a plane of symmetry normal to ``axis`` that it holds, (n,
    6).
    """
    held = np.zeros((len(of.points), 6), bool)
    held[on, axis] = True
    inside = np.abs(of.frames.reshape(-1, 3, 3)[:, axis]) < 1e-9  # axes of the nodes in the plane
    held[:, 3:] = inside & on[:, None]
    return held


def cylinder(n, radius, half, degrees, thickness, modulus, poisson):
    """A part of a cylinder about y, from its crown down, with half of its length along y."""
    whole = np.radians(degrees)

    def place(u, v):
        a = whole * u
        return np.column_stack([radius * np.sin(a), half * v, radius * np.cos(a)])

    def normal(u, v):
        return np.column_stack([np.sin(whole * u), 0.0 * u, np.cos(whole * u)])

    of = surface((n, n), place, normal, thickness, modulus, poisson)
    return of, of.rest[:-2].reshape(-1, 6)[:, :3]


def drilling(of):
    held = np.zeros((len(of.points), 6), bool)
    held[:, 5] = True
    return held


def roof(n):
    """Scordelis and Lo's roof under its weight: deflection of the middle of a free edge."""
    of, points = cylinder(n, 25.0, 25.0, 40.0, 0.25, 4.32e8, 0.0)
    held = drilling(of) | mirrored(of, np.isclose(points[:, 0], 0.0), 0)
    held |= mirrored(of, np.isclose(points[:, 1], 0.0), 1)
    held[np.isclose(points[:, 1], 25.0)] |= np.array([1, 0, 1, 0, 0, 0], bool)
    load = np.zeros((len(points), 6))
    np.add.at(load[:, 2], of.walls.quads, -90.0 * 0.25 * of.walls.area.sum(axis=1)[:, None])
    edge = np.argmax(points[:, 0] - points[:, 1])
    return -solved(of, sheets.hooke(4.32e8, 0.0), held, load)[edge, 2] / 0.3024


def pinched(n):
    """A cylinder with diaphragms, pinched by two forces: deflection under one of them."""
    of, points = cylinder(n, 300.0, 300.0, 90.0, 3.0, 3e6, 0.3)
    held = drilling(of)
    for on, axis in ((points[:, 0], 0), (points[:, 1], 1), (points[:, 2], 2)):
        held |= mirrored(of, np.isclose(on, 0.0, atol=1e-9), axis)
    held[np.isclose(points[:, 1], 300.0)] |= np.array([1, 0, 1, 0, 0, 0], bool)
    load, top = np.zeros((len(points), 6)), np.argmax(points[:, 2] - points[:, 1])
    load[top, 2] = -0.25
    return -solved(of, sheets.hooke(3e6, 0.3), held, load)[top, 2] / 1.8248e-5


def hemisphere(n):
    """A hemisphere with a hole of 18 degrees, pulled and pushed at its rim."""
    low, high = 0.0, np.radians(72.0)

    def normal(u, v):
        a, b = 0.5 * np.pi * u, low + (high - low) * v
        return np.column_stack([np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), np.sin(b)])

    of = surface((n, n), lambda u, v: 10.0 * normal(u, v), normal, 0.04, 6.825e7, 0.3)
    points = of.points
    held = drilling(of)
    for axis in (0, 1):
        held |= mirrored(of, np.isclose(points[:, axis], 0.0, atol=1e-9), axis)
    one = np.argmax(points[:, 0] - points[:, 2])
    other = np.argmax(points[:, 1] - points[:, 2])
    held[one, 2] = True
    load = np.zeros((len(points), 6))
    load[one, 0], load[other, 1] = 1.0, -1.0
    return solved(of, sheets.hooke(6.825e7, 0.3), held, load)[one, 0] / 0.094


@pytest.mark.parametrize(
    ("shape", "coarse", "fine"),
    [(roof, 0.015, 0.01), (pinched, 0.25, 0.065), (hemisphere, 0.015, 0.01)],
)
def test_benchmarks_of_curved_shells(shape, coarse, fine):
    """Deflections over the values of the literature, with 8 and 16 quads a side."""
    assert shape(8) == pytest.approx(1.0, abs=coarse)
    assert shape(16) == pytest.approx(1.0, abs=fine)
