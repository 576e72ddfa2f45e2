"""Lattices that repeat, for tests: a pressed period, and the coordinates that its unknowns lead."""

from contextlib import contextmanager
from unittest.mock import patch

import numpy as np
import pytest

from kernels.solve import outcomes
from sweep.config.case import Case
from sweep.design import period
from sweep.design.drawing import welded
from sweep.design.lattice import build_network
from tests.support.designs.tables import lattice_with, material_with
from tests.support.kernels.solving import at_rest, go_on, moves, ramp, whole

Y, NU, L, DEPTH = 12e6, 0.48, 4e-3, 10e-3
PLANE = Y / (1 - NU**2)
MATERIAL = material_with(modulus=Y, density=1e3, poisson=NU)
PITCH = {"hex": (0.6 * 3**0.5, 0.9), "kagome": (1.0, 0.75**0.5)}


def lattice_of(kind, cells, slenderness, repeats="boundary", **chosen):
    """A period; it repeats without end, or by its ``sides``."""
    pitch = PITCH.get(kind, (1.0, 1.0))
    width, height = (L * n * length for n, length in zip(cells, pitch, strict=True))
    return lattice_with(
        kind=kind, cells_x=cells[0], cells_y=cells[1], width=width,
        height=height, depth=DEPTH, wall_thickness=slenderness * L,
        **{repeats: "periodic"}, **chosen,
    )  # fmt: skip


def pressed(
    lattice, strain=0.6, steps=60, friction=0.0, model="barrier", unload=False, platen=None
):
    return Case.of(
        lattice=lattice,
        material=MATERIAL,
        loading=dict(mode="displacement", strain=strain, unload=unload, platen=platen),
        contact=dict(model=model, friction=friction),
        solver=dict(load_steps=steps, joints="points", tolerance=1e-10),
    )


def crushed(case, scene, steps=20):
    """Coordinates of a pressed period, and the potential of a step there."""
    state = at_rest(scene)
    outcome, _ = go_on(case, scene, state, ramp(scene, steps, travel=(0.0, case.loading.stroke)))
    assert outcome == outcomes.CONVERGED
    return state.x, whole(scene, state.x)


def follow(scene):
    """Matrix (n, free + 1) from the free coordinates and the height of the period to all
    coordinates.
    """
    return moves(scene.terms.layout)[1]


def assert_derivatives(scene, x, args):
    """Slopes and curvatures in all that is free, and led, are differences of energy and slopes."""
    follows, h = follow(scene), 1e-7 * L
    scale = np.append(scene.terms.coordinates.scale[follows.argmax(axis=0)][:-1], 1.0)
    steps = h / scale
    slope, curvature = follows.T @ args.gradient(x), follows.T @ args.hessian(x) @ follows
    ways = list(zip((follows * steps).T, steps, strict=True))
    sides = [
        [(args.energy(x + s * way), args.gradient(x + s * way)) for s in (1, -1)] for way, _ in ways
    ]
    size = np.abs(args.gradient(x)).max()
    for k, (one, other) in enumerate(sides):
        found = (one[0] - other[0]) / (2 * steps[k])
        assert found / scale[k] == pytest.approx(slope[k] / scale[k], abs=1e-4 * size)
        found = follows.T @ (one[1] - other[1]) / (2 * steps[k])
        most = np.abs(curvature[:, k]).max()
        np.testing.assert_allclose(found, curvature[:, k], rtol=0, atol=1e-5 * most)


def assert_solved(scene, x, args, drifts=False):
    """The factor solves as dense algebra does, with walls condensed and, in contact, open.

    drifts: nothing holds the nodes in x; then no force pulls them along, and drifts are left out.
    """
    follows = follow(scene)[:, :-1]
    negative, _, missing = args.factor(x)
    assert (negative, missing) == (False, False)
    b, along = np.random.default_rng(0).uniform(-1, 1, x.size), np.zeros(x.size)
    along[: 2 * scene.terms.layout.n_nodes : 2] = drifts
    way = along / max(along @ along, 1.0)
    b -= way * (along @ b)
    matrix, load = follows.T @ args.hessian(x) @ follows, follows.T @ b
    if drifts:
        values, modes = np.linalg.eigh(matrix)
        matrix += np.outer(modes[:, 0], modes[:, 0]) * values[-1]
    solved, expected = (
        each - along * (way @ each)
        for each in (args.solve(b), follows @ np.linalg.solve(matrix, load))
    )
    size = np.abs(expected).max()
    within = 1e-6 if drifts else 1e-8
    np.testing.assert_allclose(solved, expected, rtol=0, atol=within * size)


@contextmanager
def cut_elsewhere(cut):
    """Networks are built anew, with the lower left corner of the period at ``cut``, m."""

    def moved(segments, tolerance):
        return welded(segments - np.array(cut), tolerance)

    build_network.cache_clear()
    with patch.object(period, "welded", moved):
        yield
    build_network.cache_clear()


def assert_alike(one, other, friction):
    """Two cuts of a period in which walls touch have the same work, contact and friction."""
    assert one.history["contact_J"][-1] > 1e-4 * one.history["stretch_J"][-1]
    most = np.abs(one.history["work_in_J"]).max()
    within = 1e-3 * most if friction else 1e-6 * most  # rounding decides which of two walls sticks
    for name in ("work_in_J", "contact_J", "dissipated_friction_J"):
        np.testing.assert_allclose(other.history[name], one.history[name], rtol=0, atol=within)
