"""Shapes of plates: strains of quads that are moved by hand, crossings, the whole of a quarter."""

import numpy as np
import pytest

from sweep.design.upright_plan import plan_of
from sweep.scene.plates.coordinates import at_rest
from sweep.scene.plates.mesh import build_mesh, extruded
from sweep.scene.plates.scene import build_scene
from sweep.simulation.plate_shapes import (
    plate_frames,
    plate_strains,
    positions,
    principal,
    surface_crossings,
)
from tests.support.designs.plates import BOX, T, along, network


class Stand:
    """A scene with a mesh alone."""

    def __init__(self, mesh):
        self.mesh = mesh


def wall(length=4e-3, height=2e-3, quads=(8, 4), thickness=0.2e-3):
    plan = plan_of(network([[0, 0], [1e3 * length, 0]], [[0, 1]], thickness))
    return extruded(plan, np.array([quads[0]]), quads[1], height)


def shape(mesh, points):
    """Coordinates (1, 6 n + 2) with nodes at these points (n, 3)."""
    x = at_rest(mesh, "glued")
    x[:-2].reshape(-1, 6)[:, :3] = points
    return x[None]


def test_principal_strains_of_a_shear():
    """F = (1, g; 0, 1): the product of the stretches is 1, their difference is g."""
    g = 0.3
    low, high = principal(np.array([[[1.0, 1.0 + g**2, g]]]))
    assert (1.0 + low) * (1.0 + high) == pytest.approx(1.0)
    assert high - low == pytest.approx(g)


def test_strain_of_a_stretched_and_turned_wall():
    mesh = wall()
    angle = 0.7
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    least, greatest, surface = plate_strains(
        shape(mesh, mesh.rest * [1.2, 1.0, 0.9] @ turn.T), Stand(mesh)
    )
    assert least == pytest.approx(-0.1)
    assert greatest == pytest.approx(0.2)
    assert surface == pytest.approx(0.2)


def test_surface_strain_of_a_rolled_wall():
    """It is t / (2 r) of a wall rolled to a radius r; the chords are a little shorter."""
    mesh, radius = wall(quads=(40, 4)), 3e-3
    s = mesh.rest[:, 0] / radius
    rolled = np.column_stack([radius * np.sin(s), radius * np.cos(s), mesh.rest[:, 2]])
    least, greatest, surface = plate_strains(shape(mesh, rolled), Stand(mesh))
    assert surface[0, 4:-4].min() == pytest.approx(0.2e-3 / (2.0 * radius), rel=0.05)
    assert np.abs(least).max() < 1e-3
    assert np.abs(greatest).max() < 1e-3


def test_bow_at_rest_has_no_strain():
    mesh = build_mesh(along(imperfection=0.5).lattice)
    for strain in plate_strains(at_rest(mesh, "glued")[None], Stand(mesh)):
        assert np.abs(strain).max() < 1e-12


def test_walls_at_rest_do_not_cross_and_a_wall_that_is_pushed_through_another_does():
    mesh = build_mesh(along(cells_x=1, cells_y=1, nodes_per_wall=3, imperfection=0.0).lattice)
    rest = mesh.rest[None]
    assert surface_crossings(rest, mesh) == 0
    moved = rest.copy()
    left = mesh.flat & (mesh.rest[:, 0] < 1e-9) & (np.abs(mesh.rest[:, 2] - 0.5 * BOX) < 2e-3)
    moved[0, left, 0] += 1.1 * BOX
    assert left.any()
    assert surface_crossings(moved, mesh) > 0


def test_walls_that_leave_a_mirror_plane_cross_their_images():
    mesh = build_mesh(along(cells_x=1, cells_y=1, symmetry="quarter", imperfection=0.0).lattice)
    whole = plate_frames(at_rest(mesh, "glued")[None], np.zeros(1), np.zeros(1), Stand(mesh))
    assert surface_crossings(whole["position_m"], mesh) == 0
    points = mesh.rest.copy()
    inside = mesh.flat & ~mesh.on.any(axis=1) & (np.abs(points[:, 2] - 0.5 * BOX) < 1e-3)
    points[inside & (points[:, 0] < 1e-9), 0] = 0.55 * BOX
    whole = plate_frames(shape(mesh, points), np.zeros(1), np.zeros(1), Stand(mesh))
    assert surface_crossings(whole["position_m"], mesh) > 0


def test_frames_hold_the_whole_lattice():
    case = along(cells_x=1, cells_y=1, symmetry="quarter", grading=1.0)
    scene = build_scene(case)
    frames = plate_frames(scene.x_rest[None], np.zeros(1), np.zeros(1), scene)
    assert frames["position_m"].shape == (1, 4 * 6 * (scene.mesh.layers + 1), 3)
    assert frames["quads"].shape == (4 * len(scene.mesh.quads), 4)
    assert frames["quad_thickness_m"] == pytest.approx(T)
    assert frames["plate_y_m"].tolist() == [[0.0, BOX]]
    bowed = [BOX, BOX + 0.01 * T, BOX]  # walls along x bow outwards, those along y inwards
    assert frames["position_m"][0].max(axis=0) == pytest.approx(bowed, rel=1e-9)
    assert np.array_equal(positions(scene.x_rest[None], scene.mesh.n_nodes)[0], scene.mesh.rest)
