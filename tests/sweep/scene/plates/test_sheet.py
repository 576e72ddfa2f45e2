"""One period of a sheet: images, derivatives of its step, and two periods for twice as much."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numba import typeof
from scipy.spatial import cKDTree

from kernels.plates.contacts.contact import MOST_THICKENING
from kernels.plates.contacts.thickness import THICKENING
from kernels.shared.rows import CONTACT
from sweep.config.case import Case
from sweep.design.surfaces.nets import build_net
from sweep.scene.plates.coordinates import leaders
from sweep.scene.plates.scene import build_scene, scene_of
from sweep.scene.plates.sheet import bowed, build_sheet, mesh_of_sheet
from tests.support.designs.plates import repeated
from tests.support.kernels.pressed_plates import (
    hessian_error,
    reduction,
    shaken,
    slope,
    unit,
    whole,
)

HEIGHT, T, FLAT = 4e-3, 0.25e-3, 0.55
REACH = 0.9e-3  # thickness over which walls touch here, so that a moderate shape has contacts
STEP = 1e-6  # of differences, in units of the coordinates


def case(direction="out_of_plane", platen="glued", **lattice):
    """A gyroid of about one period of 4 mm."""
    sizes = {"height": HEIGHT, "depth": HEIGHT, "cell_size": HEIGHT, "wall_thickness": T}
    mesh = {"kind": "gyroid", "nodes_per_wall": 2}
    return pressed(sizes | mesh | lattice, direction, platen)


def pressed(lattice, direction, platen):
    return Case.of(
        lattice=lattice,
        material=dict(name="ultimaker_tpu95a", stretch="linear"),
        loading=dict(mode="displacement", strain=0.5, direction=direction, platen=platen),
    )


PRINTED = dict(
    slicer="prusa",
    pattern="gyroid",
    infill=0.165,
    line_width=0.3e-3,
    fill_angle=0.0,
    nodes_per_wall=2,
)
BLOCK = PRINTED | dict.fromkeys(("width", "height", "depth"), 0.5 * HEIGHT)
BLOCK |= {"perimeters": 1, "fill_angle": 0.25 * np.pi}
CASES = {
    "glued": case(),
    "clamped": case(platen="clamped"),
    "loose": case(platen="contact"),
    "block": pressed(BLOCK, "out_of_plane", "glued"),
    "loose block": pressed(BLOCK, "in_plane", "contact"),
    "turned": pressed(PRINTED | {"height": HEIGHT}, "in_plane", "glued"),
}


@cache
def scene(name):
    return touching(build_scene(CASES[name]))


def touching(of):
    """The scene with walls that touch over `REACH`."""
    contact = of.terms.contact
    thickness = np.full_like(contact.thickness, REACH)
    contact = contact._replace(
        thickness=thickness.copy(), rest_thickness=thickness, reach=MOST_THICKENING * REACH
    )
    return replace(of, terms=of.terms._replace(contact=contact))


def squeezed(of, seed=0):
    """The sheet pressed until it touches itself and its images, unevenly, with the platens.

    Directors turn with the normals of the sheet.
    """
    x, mesh = of.x_rest.copy(), of.mesh
    nodes = x[:-2].reshape(-1, 6)
    nodes[:, 2] *= FLAT
    before = mesh.frames.reshape(-1, 3, 3)[..., 2]
    after = before / [1.0, 1.0, FLAT]
    axis = np.cross(before, after / np.linalg.norm(after, axis=1)[:, None])
    sine = np.linalg.norm(axis, axis=1)
    turn = axis * (np.tan(0.25 * np.arcsin(sine)) / np.maximum(sine, 1e-12))[:, None]
    nodes[:, 3:] = np.einsum("nij,ni->nj", mesh.frames.reshape(-1, 3, 3), turn)
    x[-2:] = [x[-2], nodes[:, 2].max() + (x[-1] - mesh.height)]
    return tied(of, shaken(of, x, seed, 0.03))


def tied(of, x):
    """Images moved as their originals, and coordinates that follow the platen."""
    layout, rest = of.terms.layout, of.x_rest
    move = x - rest
    follows = layout.leader >= 0
    move[follows] = move[layout.leader[follows]]
    return rest + move


STATES = {"bent": lambda of: tied(of, shaken(of, of.x_rest, 1, 0.05)), "squeezed": squeezed}


def test_a_sheet_runs_on_the_machine_code_of_prisms():
    """Another layout of a single array would compile all of it again, which takes a minute."""
    cell = {"cells_x": 1, "cells_y": 1, "nodes_per_wall": 1, "layers": 2}
    prism = build_scene(pressed(cell, "out_of_plane", "glued"))
    assert typeof(scene("glued").terms) == typeof(prism.terms)


@pytest.mark.parametrize("name", CASES)
def test_images_are_a_period_away(name):
    mesh = scene(name).mesh
    period = mesh.net.box.size[:2]
    move = mesh.rest - mesh.rest[mesh.original]
    np.testing.assert_allclose(move[:, :2], mesh.shift * period, atol=1e-15)
    assert not move[:, 2].any()
    np.testing.assert_array_equal(mesh.original[mesh.own], mesh.own)
    assert not mesh.area[len(mesh.own) :].any()
    assert not mesh.volume[len(mesh.own) :].any()
    np.testing.assert_allclose(mesh.rest[mesh.quads], mesh.net.corners, atol=1e-15)


def test_images_of_triangles_stand_all_round():
    """Wherever a node is, all of the surface within half a period is there."""
    mesh = scene("glued").mesh
    period, places = mesh.net.box.size[:2], mesh.rest[mesh.triangles].mean(axis=1)
    own = places[: 2 * len(mesh.quads)]
    tree = cKDTree(places)
    for shift in [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)]:
        moved = own + np.append(shift * period, 0.0)
        near = np.all((moved[:, :2] > -0.4 * period) & (moved[:, :2] < 1.4 * period), axis=1)
        assert tree.query(moved[near])[0].max() < 1e-9


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", CASES)
def test_the_gradient_is_that_of_the_energy(name, state):
    of = scene(name)
    x = STATES[state](of)
    args, R = whole(of, x), reduction(of)
    g = R.T @ args.gradient(x)
    if state == "squeezed":
        assert args.problem.neighbours.touching.count[0] > 20
    for seed in range(3):
        move = R.T @ unit(of) * np.random.default_rng(seed).uniform(-1, 1, R.shape[1])
        assert slope(args.energy, x, R @ move, STEP) == pytest.approx(
            g @ move, abs=1e-8 * np.linalg.norm(g * move)
        )


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", CASES)
def test_the_matrix_is_the_hessian(name, state):
    of = scene(name)
    for seed in range(2):
        assert hessian_error(of, STATES[state](of), seed, STEP) < 1e-6


def test_two_periods_take_twice_the_energy_of_one():
    """In any shape that repeats, contact between images included."""
    box = scene("glued").mesh.net.box
    single, double = (
        touching(scene_of(CASES["glued"], build_sheet(net, np.full(len(net.quads), T)), None, 1.0))
        for net in (
            build_net(replace(box, size=box.size * [count, 1, 1]), (6 * count, 6, 6))
            for count in (1, 2)
        )
    )
    x = squeezed(single)
    y = repeated(single, double, x, box.size[:2])
    one, two = (whole(of, at).found(at)[1].stored for of, at in ((single, x), (double, y)))
    assert one[CONTACT] > 0.02 * one.sum()
    np.testing.assert_allclose(two, 2.0 * one, rtol=1e-9)


def test_images_are_as_thick_as_their_originals():
    of = scene("glued")
    x = squeezed(of)
    args = whole(of, x)
    args.problem.project(x)
    j = args.problem.buffers.committed[:, THICKENING]
    assert j.min() > 0.5
    np.testing.assert_array_equal(j, j[of.mesh.original])
    assert np.ptp(j) > 1e-3


def test_an_imperfection_moves_nodes_along_normals_and_none_on_the_platens():
    lattice = case(imperfection=0.1, imperfection_seed=3).lattice
    net = mesh_of_sheet(case(imperfection=0.0).lattice).net
    move = bowed(net, lattice).points - net.points
    size = np.linalg.norm(move, axis=1)
    assert np.sqrt(np.mean(size**2)) == pytest.approx(0.1 * T, rel=0.5)
    assert max(size[net.bottom].max(), size[net.top].max()) < 1e-15
    along = np.abs((move * net.normals).sum(axis=1))
    np.testing.assert_allclose(along, size, atol=1e-15)
    other = bowed(net, case(imperfection=0.1, imperfection_seed=4).lattice).points
    assert np.abs(other - net.points - move).max() > 0.1 * size.max()


def test_nodes_where_walls_meet_turn_about_all_axes_and_have_a_director_of_each():
    mesh = scene("block").mesh
    joints = ~mesh.flat
    net, corner = mesh.net, mesh.directors
    planes = net.on_surface + (net.face[:, :2] != 0).sum(axis=1)
    np.testing.assert_array_equal(joints, planes > 1)
    frames = mesh.frames.reshape(-1, 3, 3)[mesh.quads]
    np.testing.assert_allclose(
        np.einsum("mcij,mcj->mci", frames, corner), net.corner_normals, atol=1e-12
    )
    free = leaders(mesh, "glued")[:-2].reshape(-1, 6) >= 0
    inner = net.face[:, 2] == 0
    np.testing.assert_array_equal(free[inner, 5], joints[inner])


def test_a_wall_that_is_glued_to_a_platen_does_not_turn():
    mesh = build_scene(pressed(BLOCK, "in_plane", "glued")).mesh
    leader = leaders(mesh, "glued")[:-2].reshape(-1, 6)
    assert np.all(leader[np.concatenate([mesh.bottom, mesh.top]), 3:] == -1)
