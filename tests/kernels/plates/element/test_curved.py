"""Shells of any quads: derivatives, patches, and the benchmarks of curved shells.

The benchmarks and their numbers are due to R. MacNeal and R. Harder (Finite Elements in Analysis
and Design 1, 1985) and to T. Belytschko et al. (CMAME 51, 1985).
"""

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from kernels.plates.element import rotation, shell
from tests.support.kernels import sheets
from tests.support.kernels.shells import (
    LINEAR,
    Structure,
    element_hessians,
    mapped,
    shaken,
    smooth,
    stored,
    surface,
    term_of,
)
from tests.support.kernels.terms import derivative_error

RUBBER = sheets.elastic_only(sheets.sheet_of_rubber())


def saddle(shake=0.2, grid=(2, 2)):
    """A warped patch of a saddle, with quads that are neither flat nor rectangles."""

    def place(u, v):
        return np.column_stack([u + 0.3 * v, v, 0.4 * (u - 0.5) * (v - 0.4)])

    def normal(u, v):
        slopes = np.column_stack([-0.4 * (v - 0.4), -0.4 * (u - 0.5) + 0.12 * (v - 0.4)])
        n = np.column_stack([slopes, np.ones(len(u))])
        return n / np.linalg.norm(n, axis=1)[:, None]

    return surface(grid, place, normal, shake=shake)


def flat(shake, grid=(3, 3)):
    """A skew plate in the plane of x and y, of distorted quads."""
    return surface(
        grid,
        lambda u, v: np.column_stack([1.2 * u + 0.3 * v, v, 0.0 * u]),
        lambda u, v: np.tile([0.0, 0.0, 1.0], (len(u), 1)),
        shake=shake,
    )


@pytest.mark.parametrize("law", [LINEAR, RUBBER], ids=["linear", "rubber"])
@pytest.mark.parametrize("state", [(0.0, 0.0), (0.05, 0.05), (0.15, 0.2)])
def test_derivatives(state, law):
    of = saddle()
    x = shaken(of, 1, *state)
    step, tolerance = (2e-4, 1e-9) if law is LINEAR else (1e-5, 1e-5)
    assert derivative_error(term_of(of, law), x, of.unit, step) < tolerance


def test_the_rest_shape_is_free_of_stress():
    of = saddle()
    energy, gradient = term_of(of).energy_gradient(of.rest)
    assert energy == pytest.approx(0.0, abs=1e-25)
    np.testing.assert_allclose(gradient, 0.0, atol=1e-12)


@pytest.mark.parametrize("w", [(0.1, 0.2, -0.3), (1.5, -2.0, 0.7)])
def test_rigid_motions_cost_nothing(w):
    of, w = saddle(), np.array(w)
    x = mapped(of, lambda p: np.array([rotation.turned(w, tuple(q)) for q in p]) + 0.3)
    for i, frame in enumerate(of.frames):
        x[6 * i + 3 : 6 * i + 6] = frame.reshape(3, 3).T @ w
    energy, gradient = term_of(of).energy_gradient(x)
    assert energy < 1e-24
    np.testing.assert_allclose(gradient, 0.0, atol=1e-11)


def test_areas_are_those_of_the_quads():
    assert flat(0.25).walls.area.sum() == pytest.approx(1.2, rel=1e-12)


@pytest.mark.parametrize("law", [LINEAR, RUBBER], ids=["linear", "rubber"])
def test_uniform_stretch_is_exact_on_distorted_quads(law):
    of, f = flat(0.25), np.array([[1.2, 0.1, 0.0], [-0.2, 0.9, 0.0], [0.0, 0.0, 1.0]])
    c = (f.T @ f)[:2, :2]
    expected = 0.12 * law.elastic.respond(c[0, 0] - 1, c[1, 1] - 1, c[0, 1])[0]
    membrane, bending, sheared = stored(of, mapped(of, lambda p: p @ f.T), law)
    assert membrane == pytest.approx(expected, rel=1e-12)
    assert (bending, sheared) == pytest.approx((0.0, 0.0), abs=1e-12 * expected)


def test_uniform_curvature_is_exact_on_distorted_quads():
    """A cylinder, to the second order of its curvature, held across."""
    k, of = 1e-5, flat(0.25)
    x = of.rest
    rows, s = x[:-2].reshape(-1, 6), of.points[:, 0]
    rows[:, 2] += 0.5 * k * s**2
    turn = np.zeros((len(s), 3))
    turn[:, 1] = -0.25 * k * s  # about y, so that the normal leans by -k s
    rows[:, 3:] = np.einsum("nij,ni->nj", of.frames.reshape(-1, 3, 3), turn)
    expected = 0.5 * 12.0 * 0.1**3 / 12 / 0.75 * k**2 * 1.2
    assert stored(of, x).sum() == pytest.approx(expected, rel=1e-5)


def test_an_element_does_not_depend_on_its_first_corner():
    of = saddle(grid=(1, 1))
    x, whole = shaken(of, 3, 0.1, 0.1), []
    for first in range(4):
        other = smooth(
            of.points, of.frames.reshape(-1, 3, 3)[:, :, 2], np.roll(of.walls.quads, first, 1)
        )
        whole.append(stored(Structure(of.points, of.frames, other.walls), x).sum())
    np.testing.assert_allclose(whole, whole[0], rtol=1e-12)


def test_a_rectangle_is_a_special_case():
    of = flat(0.0, (2, 2))
    plain = surface(
        (2, 2),
        lambda u, v: np.column_stack([1.2 * u, v, 0.0 * u]),
        lambda u, v: np.tile([0.0, 0.0, 1.0], (len(u), 1)),
    )
    walls = plain.walls
    as_flat = shell.rectangles(
        walls.quads, walls.size, walls.thickness, walls.directors, walls.shear_modulus,
        walls.fold_modulus,
    )  # fmt: skip
    x = shaken(plain, 2, 0.1, 0.1)
    flat_one = Structure(plain.points, plain.frames, as_flat)
    np.testing.assert_allclose(stored(plain, x), stored(flat_one, x), rtol=1e-12)
    assert of.walls.axes.shape[0] == 4


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
