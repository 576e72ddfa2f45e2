"""Meshes of walls: equal elements along them, the imperfection, openings round joints, rows."""

import numpy as np
import pytest

from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.scene.mesh import build_mesh, row_nodes, split_walls
from tests.support.designs.tables import lattice_with

SHIFT = 2e-4


def network_of(kind):
    return build_network(lattice_with(kind=kind, width=20e-3, height=18e-3).geometry)


@pytest.mark.parametrize("kind", families())
def test_walls_fall_into_equal_elements(kind):
    network = network_of(kind)
    count = 1 + np.arange(len(network.walls)) % 4
    mesh = split_walls(network, count, 0.0)
    np.testing.assert_array_equal(np.bincount(mesh.wall), count)
    np.testing.assert_array_equal(np.diff(mesh.start), count)
    np.testing.assert_allclose(mesh.rest_length, (network.length / count)[mesh.wall], rtol=1e-12)
    first, last = mesh.edges[mesh.start[:-1], 0], mesh.edges[mesh.start[1:] - 1, 1]
    np.testing.assert_array_equal(np.column_stack([first, last]), network.walls)
    before, node, after = mesh.inner.T
    assert len(node) == len(mesh.points) - len(network.points)
    np.testing.assert_array_equal(mesh.edges[before, 1], node)
    np.testing.assert_array_equal(mesh.edges[after, 0], node)


def test_nodes_share_out_length_and_area():
    mesh = split_walls(network_of("hex"), 3, 0.0)
    assert mesh.node_length.sum() == pytest.approx(mesh.rest_length.sum())
    np.testing.assert_allclose(mesh.node_area, 0.8e-3 * mesh.node_length, rtol=1e-12)
    inside = mesh.node_length[mesh.n_joints :]
    np.testing.assert_allclose(inside, mesh.rest_length[mesh.inner[:, 0]], rtol=1e-12)


@pytest.mark.parametrize("kind", families())
def test_openings_round_a_node_make_a_turn(kind):
    mesh = split_walls(network_of(kind), 2, SHIFT)
    nodes, opened, ends = mesh.openings
    shared = np.flatnonzero(np.bincount(mesh.edges.ravel()) > 1)
    np.testing.assert_array_equal(np.unique(nodes[:, 1]), shared)
    around = np.bincount(nodes[:, 1], opened)[shared]
    np.testing.assert_allclose(around, 2 * np.pi, rtol=1e-12)
    for k, outer in ((0, 0), (1, 2)):
        found = np.sort(mesh.edges[ends[:, k]], axis=1)
        np.testing.assert_array_equal(found, np.sort(nodes[:, [1, outer]], axis=1))
    one, other = (mesh.points[nodes[:, k]] - mesh.points[nodes[:, 1]] for k in (0, 2))
    cosine = (one * other).sum(axis=1)
    cosine /= np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1)
    np.testing.assert_allclose(np.cos(opened), cosine, rtol=0, atol=1e-12)


def test_the_imperfection_is_half_a_sine_over_the_height():
    network = network_of("square")
    straight, bent = (split_walls(network, 4, shift).points for shift in (0.0, SHIFT))
    moved = bent - straight
    np.testing.assert_array_equal(moved[:, 1], 0.0)
    wave = SHIFT * np.sin(np.pi * straight[:, 1] / 18e-3)
    np.testing.assert_allclose(moved[:, 0], wave, rtol=0, atol=1e-17)


def test_the_mesh_of_a_lattice_has_its_nodes_and_its_imperfection():
    lattice = lattice_with(nodes_per_wall=3, imperfection=0.5)
    mesh, _ = build_mesh(lattice, False, "glued")
    assert (len(mesh.points), len(mesh.edges)) == (16 + 24 * 3, 24 * 4)
    assert np.ptp(mesh.points[:, 0]) == pytest.approx(12.5e-3 + 0.5 * 0.8e-3, rel=1e-3)


@pytest.mark.parametrize("kind", ["square", "hex"])
def test_an_outer_row_has_the_nodes_of_its_walls(kind):
    """The nodes of a honeycomb are corners of cells, with no wall between them."""
    network = network_of(kind)
    mesh = split_walls(network, 4, 0.0)
    for joints, y in ((network.bottom, 0.0), (network.top, 18e-3)):
        row = row_nodes(network, mesh, joints)
        np.testing.assert_array_equal(row, np.flatnonzero(np.isclose(mesh.points[:, 1], y)))
        assert len(row) == {"square": 3 * 4 + 1, "hex": len(joints)}[kind]


def test_pieces_of_a_perimeter_are_not_split_into_slivers():
    """Its walls are as long as the infill leaves them; elements are as long as thick."""
    lattice = lattice_with(slicer="prusa", pattern="stars", infill=0.3, width=20e-3, height=20e-3)
    for solid in (True, False):
        mesh, _ = build_mesh(lattice, solid, "glued")
        beams = np.flatnonzero(mesh.joint < 0)
        pieces = np.bincount(mesh.wall[beams])[mesh.wall[beams]]
        split = beams[pieces > 1]
        assert len(split) > 100
        assert (mesh.rest_length[split] >= (1.0 - 1e-9) * mesh.thickness[split]).all()


def test_equal_walls_have_equal_meshes_where_a_whole_number_of_elements_just_fits():
    """Hexagons of 0.5 mm in 18 mm: half of the walls hold 12 shortest elements but for round-off,
    and wanted are 12.
    """
    cells = {"kind": "hex", "cells_x": 3, "cells_y": 3, "width": 18e-3, "height": 18e-3}
    lattice = lattice_with(wall_thickness=0.5e-3, nodes_per_wall=11, **cells)
    mesh, arms = build_mesh(lattice, True, "glued")
    count = np.bincount(mesh.wall[mesh.joint < 0])
    whole = np.bincount(mesh.wall, mesh.rest_length)
    free = np.round(whole - arms.length.sum(axis=1), 9)
    for length in np.unique(free):
        assert len({*count[free == length]}) == 1
