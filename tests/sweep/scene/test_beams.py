"""Constants of the elements: shear, arcs, and the factors of plane strain."""

from dataclasses import replace

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.design.lattice import build_network
from sweep.scene.beams import build_beams, contraction
from sweep.scene.bending import build_bend
from sweep.scene.joints import point_joints, solid_joints
from sweep.scene.mesh import build_mesh, split_walls
from tests.support.designs.tables import lattice_with, material_with

DEPTH, T, NU, Y = 12e-3, 0.8e-3, 0.4, 12e6
MATERIAL = {"modulus": Y, "density": 1e3, "poisson": NU}


def beams(plane="stress", solid=True, **solver):
    """The elements of a grid, three between the joints of a wall."""
    lattice = lattice_with(nodes_per_wall=2)
    network = build_network(lattice.geometry)
    arms = solid_joints(network, "glued") if solid else point_joints(len(network.walls))
    mesh = split_walls(network, 3, 0.0, arms.length)
    material = material_with(plane=plane, **MATERIAL)
    return mesh, build_beams(mesh, arms, Case.of(material=material, solver=solver))


@pytest.mark.parametrize("plane", ["stress", "strain"])
def test_a_sheared_element_is_timoshenkos(plane):
    """Its tip under a force at the end: h^3 / (3 Y' I) + h / S."""
    mesh, found = beams(plane)
    inside = np.flatnonzero(~found.joint & (found.shear > 0.0))
    assert len(inside) > 50
    h = mesh.rest_length[inside]
    k11, k12, k22 = found.stiffness[:, inside]
    modulus = Y / (1.0 - NU**2) if plane == "strain" else Y
    shear = 5.0 / 6.0 * Y / (2.0 * (1.0 + NU)) * DEPTH * T
    sway = 1.0 / (k11 - k12**2 / k22) * h**2  # clamped at one end, its moment free at the other
    np.testing.assert_allclose(found.rigidity[inside], modulus * DEPTH * T**3 / 12.0, rtol=1e-12)
    expected = h**3 / (3.0 * found.rigidity[inside]) + h / shear
    np.testing.assert_allclose(sway, expected, rtol=1e-12)
    np.testing.assert_array_equal(k11, k22)


def test_the_arc_of_a_sheared_element():
    """(2 b_1^2 - b_1 b_2 + 2 b_2^2) / 30 - g^2 / 2 with b_i = a_i - g, g = p (a_1 + a_2)."""
    _, found = beams()
    turns = np.random.default_rng(0).uniform(-1.0, 1.0, (2, 20))
    for k in np.flatnonzero(~found.joint):
        g = 0.5 * found.shear[k] / (1.0 + found.shear[k]) * turns.sum(axis=0)
        b1, b2 = turns - g
        expected = (2.0 * b1**2 - b1 * b2 + 2.0 * b2**2) / 30.0 - 0.5 * g**2
        same, mixed = found.arc[:, k]
        arc = same * np.sum(turns**2, axis=0) + mixed * turns[0] * turns[1]
        np.testing.assert_allclose(arc, expected, rtol=1e-12, atol=1e-15)


def test_joints_are_straight_and_not_sheared_elements():
    mesh, found = beams()
    np.testing.assert_array_equal(found.joint, mesh.joint >= 0)
    assert not found.arc[:, found.joint].any()
    walls = DEPTH * mesh.thickness
    np.testing.assert_array_equal(found.area[~found.joint], walls[~found.joint])
    assert np.all(found.area[found.joint] != walls[found.joint])


def test_contraction_across_a_fibre():
    material = {plane: material_with(plane=plane, **MATERIAL) for plane in ("stress", "strain")}
    assert contraction(material["stress"]) == NU
    assert contraction(material["strain"]) == pytest.approx(NU / (1.0 - NU))


def test_a_printed_honeycomb_bends_as_its_layers_do():
    """Layers of 2 s, s and s: area 4 s, second moment (8 + 1 + 1) s^3 / 12, of three layers."""
    lattice = lattice_with(
        slicer="prusa", pattern="honeycomb", infill=0.2, width=20e-3, height=20e-3
    )
    case = Case.of(lattice=lattice, material=dict(plane="stress", **MATERIAL))
    mesh, arms = build_mesh(lattice, True, "glued")
    found, line = build_beams(mesh, arms, case), lattice.line
    infill = mesh.thickness < 1.5 * line
    between = infill & ~found.joint
    assert between.sum() > 100
    np.testing.assert_allclose(found.area[between], 4.0 / 3.0 * line * DEPTH, rtol=1e-12)
    layers = np.array([2.0, 1.0, 1.0]) * line
    expected = Y * DEPTH * np.mean(layers**3) / 12.0
    np.testing.assert_allclose(found.rigidity[between], expected, rtol=1e-12)
    bend = build_bend(mesh, found, case.model_copy(update={"material": material_with()}))
    across = bend.spread[0, between] * mesh.rest_length[between]
    fibres = 4.0 * bend.volume[between] / mesh.rest_length[between] * across**2  # two pairs
    np.testing.assert_allclose(Y * fibres, expected, rtol=1e-12)
    even = build_beams(replace(mesh, gyration=np.ones_like(mesh.thickness)), arms, case)
    joints = infill & found.joint & (even.stiffness[0] > 0.0)
    assert joints.any()
    ratio = found.stiffness[:, joints] / even.stiffness[:, joints]
    np.testing.assert_allclose(ratio, 1.40625, rtol=1e-12)
    walls = ~infill
    np.testing.assert_array_equal(found.stiffness[:, walls], even.stiffness[:, walls])
