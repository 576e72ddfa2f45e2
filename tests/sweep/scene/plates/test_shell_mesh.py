"""Upright walls that repeat along both sides: images of columns, two periods for twice as much."""

from functools import cache

import numpy as np
import pytest

from kernels.shared.rows import CONTACT
from sweep.config.case import Case
from sweep.scene.plates.scene import build_scene
from sweep.simulation.simulate import simulate
from tests.support.designs.plates import repeated
from tests.support.kernels.pressed_plates import shaken, whole

PITCH, T = 4e-3, 0.4e-3
FAMILIES = {"square": (2, 2), "hex": (1, 2), "triangle": (1, 2), "kagome": (1, 2)}


def case(kind="square", cells=(2, 2), strain=0.02, **lattice):
    """Walls of cells of 4 mm, 4 mm high."""
    sizes = {"width": PITCH * cells[0], "height": PITCH * cells[1], "depth": PITCH}
    return Case.of(
        lattice={"kind": kind, "cells_x": cells[0], "cells_y": cells[1], "wall_thickness": T}
        | sizes | {"sides": "periodic", "nodes_per_wall": 1, "layers": 4, "imperfection": 0.1}
        | lattice,
        material=dict(name="ultimaker_tpu95a", stretch="linear"),
        loading=dict(mode="displacement", strain=strain, direction="out_of_plane", unload=False),
        solver=dict(load_steps=4, tolerance=1e-10),
    )  # fmt: skip


@cache
def scene(kind):
    return build_scene(case(kind, FAMILIES[kind]))


@pytest.mark.parametrize("kind", FAMILIES)
def test_images_are_a_period_away_and_frames_those_of_originals(kind):
    mesh = scene(kind).mesh
    move = mesh.rest - mesh.rest[mesh.original]
    np.testing.assert_allclose(move[:, :2], mesh.shift * mesh.period, atol=1e-12)
    np.testing.assert_allclose(move[:, 2], 0.0, atol=1e-15)
    np.testing.assert_array_equal(mesh.frames, mesh.frames[mesh.original])
    np.testing.assert_array_equal(mesh.original[mesh.own], mesh.own)


@pytest.mark.parametrize("kind", FAMILIES)
def test_the_walls_of_a_period_have_all_its_area(kind):
    """The area equals the same cells of a lattice with free sides, without its last walls."""
    mesh, case_ = scene(kind).mesh, case(kind, FAMILIES[kind])
    lattice = case_.lattice
    expected = sum(mesh.plan.length[: len(np.unique(mesh.wall))]) * lattice.depth
    assert mesh.area.sum() == pytest.approx(expected, rel=1e-12)
    thin = case(kind, FAMILIES[kind], wall_thickness=1e-3 * T).lattice
    filled = mesh.area.sum() * T / (lattice.width * lattice.height * lattice.depth)
    drawn = thin.network.printed_area * 1e3 / (thin.width * thin.height)
    assert filled == pytest.approx(drawn, rel=5e-3)


def test_positions_of_images_follow_from_those_that_are_stored():
    mesh = scene("hex").mesh
    stored = mesh.rest[None, mesh.shown]
    np.testing.assert_allclose(mesh.with_images(stored)[0], mesh.rest, atol=1e-12)


def test_two_periods_take_twice_the_energy_of_one():
    """In any shape that repeats: walls bulge until they touch the walls of the next cell."""
    single, double = (build_scene(case(cells=(count, 2))) for count in (2, 4))
    mesh, x = single.mesh, single.x_rest.copy()
    bulge = np.sin(np.pi * mesh.rest[:, 2] / PITCH) * (0.5 * PITCH - 0.35 * T)
    middle = np.isclose(mesh.rest[:, 0] % PITCH, 0.5 * PITCH, atol=0.2 * T)
    way = np.where(mesh.rest[middle, 1] % (2 * PITCH) < T, 1, -1)
    x[:-2].reshape(-1, 6)[middle, 1] += bulge[middle] * way
    moves = shaken(single, x, 1, 0.02) - single.x_rest
    moves[:-2] = moves[:-2].reshape(-1, 6)[mesh.original].ravel()
    x = single.x_rest + moves
    y = repeated(single, double, x, mesh.period)
    one, two = (whole(of, at).found(at)[1].stored for of, at in ((single, x), (double, y)))
    assert one[CONTACT] > 1e-3 * one.sum()
    np.testing.assert_allclose(two, 2.0 * one, rtol=1e-9)


@pytest.mark.parametrize("made", ["square", "gyroid"])
def test_both_platens_bear_the_same_force(made):
    """Images at the ends of walls bear force, too; and the book is closed."""
    of = case()
    if made == "gyroid":
        sheet = dict(kind="gyroid", depth=PITCH, cell_size=PITCH, nodes_per_wall=2)
        loading = dict(strain=0.1, direction="out_of_plane", unload=False)
        of = Case.of(
            lattice=sheet | {"wall_thickness": T},
            material=dict(of.material.inputs()),
            loading=loading,
            solver=dict(load_steps=4),
        )
    result = simulate(of)
    assert result.status == "converged"
    top, bottom = (result.history[f"reaction_{end}_N"] for end in ("top", "bottom"))
    assert top[-1] > 0.1
    np.testing.assert_allclose(bottom, top, rtol=0, atol=1e-6 * top.max())
    assert abs(result.summary["energy_residual_J"]) < 1e-8 * result.summary["absorbed_energy_J"]
    assert result.summary["max_crossings"] == 0


def test_an_endless_prism_carries_what_wide_ones_carry_per_cell():
    """Before walls buckle, force over area depends on the walls alone, with or without a period."""
    forces = []
    for cells in ((2, 2), (4, 2)):
        of = case(cells=cells, strain=0.005, imperfection=0.0)
        forces.append(simulate(of).history["reaction_top_N"][-1] / np.prod(cells))
    assert forces[1] == pytest.approx(forces[0], rel=1e-6)
