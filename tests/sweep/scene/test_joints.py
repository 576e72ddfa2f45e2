"""Solid joints: compliance of their elements, which walls have them, and their mesh."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.scene.joint_kinds import AXIS, KINDS, find_joint, table
from sweep.scene.joints import MOST, joint_elements, point_joints, solid_joints
from sweep.scene.lattice import build_scene
from sweep.scene.mesh import split_walls
from tests.support.designs.tables import lattice_with

NONE = np.zeros(6, np.bool_)


def network_of(kind="square", **keys):
    return build_network(lattice_with(kind=kind, width=20e-3, height=20e-3, **keys).geometry)


def assert_stable(along, k):
    """Flexibility is positive definite."""
    assert np.all(along > 0.0)
    assert np.all(k[0] > 0.0)
    assert np.all(k[0] * k[2] > k[1] ** 2)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.48, 0.923, 1.0])
@pytest.mark.parametrize("kind", KINDS)
def test_joint_elements_are_stable(kind, nu):
    """At every angle of the table."""
    angles = table()[kind, "side" if kind in AXIS else "all"][0]
    for angle in np.linspace(angles[0], angles[-1], 60):
        opened = np.array(KINDS[kind](angle))
        c, x = find_joint(opened, NONE[: len(opened)])
        assert_stable(*joint_elements(np.zeros(len(x), int), x, c, nu))


@pytest.mark.parametrize("x", [0.6, 2.0])
@pytest.mark.parametrize("side", [0, 1])
def test_a_joint_without_excess_is_a_sheared_beam(x, side):
    """K of Timoshenko with P = 12 Y' I / (S h^2) = 2.4 (1 + nu') / x^2, over Y' depth t^2."""
    nu = 0.4
    along, k = joint_elements(np.array([side]), np.array([x]), np.zeros((1, 4, 3)), nu)
    p = 2.4 * (1.0 + nu) / x**2
    expected = np.array([4.0 + p, 2.0 - p, 4.0 + p]) / (12.0 * x * (1.0 + p))
    np.testing.assert_allclose(k[:, 0], expected, rtol=1e-12)
    assert along[0] == pytest.approx(1.0 / x)


SQUARE = find_joint(np.full(4, 90.0), NONE[:4]).compliance[0]


def test_the_other_side_is_the_mirror_image():
    c = SQUARE[None]
    (_, one), (_, two) = (joint_elements(np.array([s]), np.array([0.6]), c, 0.48) for s in (0, 1))
    np.testing.assert_allclose(one, two[::-1], rtol=1e-12)
    assert one[0] > 1.5 * one[2]


def half_wall(c, half, nu):
    """Flexibility of half a wall that sways: a joint and a beam of half (in t), by closed form."""
    mm, mv, vv = c[:3] @ np.array([1.0, nu, nu**2])
    return 4.0 * half**3 + mm * half**2 + (2.4 * (1.0 + nu) + 2.0 * mv) * half + vv


@pytest.mark.parametrize("nu", [0.3, 0.48])
def test_a_half_wall_yields_as_the_solid(nu):
    """A force at the end of a joint element and a Timoshenko beam, against F of both in series."""
    c, half, x = SQUARE, 5.0, 0.6
    _, k = joint_elements(np.zeros(1, int), np.array([x]), c[None], nu)
    matrix = np.array([[k[0, 0], k[1, 0]], [k[1, 0], k[2, 0]]])
    p = 2.4 * (1.0 + nu) / (half - x) ** 2
    beam = np.array([[4.0 + p, 2.0 - p], [2.0 - p, 4.0 + p]]) / (12.0 * (half - x) * (1.0 + p))
    total = np.zeros((4, 4))  # deflection and rotation of the inner node, of the end
    for stiffness, ends, h in ((matrix, (None, 0), x), (beam, (0, 2), half - x)):
        b = np.zeros((2, 4))
        for row, (node, sign) in enumerate(zip(ends, (1.0, -1.0), strict=True)):
            if node is not None:
                b[:, node] += sign / h  # turn of the chord with the deflections
                b[row, node + 1] += 1.0
        total += b.T @ stiffness @ b
    flexibility = np.linalg.inv(total)[2, 2]
    assert flexibility == pytest.approx(half_wall(c, half, nu), rel=1e-9)


KNOWN = ("brick", "circle", "diamond", "hex", "kagome", "reentrant", "square", "triangle")


@pytest.mark.parametrize("kind", KNOWN)
def test_all_joints_of_these_infills_are_known(kind):
    for platen in ("glued", "contact"):
        sheared = solid_joints(network_of(kind, wall_thickness=0.5e-3), platen).sheared
        assert sheared.all(), f"{np.sum(~sheared)} walls of {kind} end in points"


@pytest.mark.parametrize("kind", families())
def test_joints_leave_their_walls_and_are_points_where_unknown(kind):
    network = network_of(kind, wall_thickness=0.5e-3)
    for platen in ("glued", "contact"):
        arms = solid_joints(network, platen)
        assert np.all(arms.length.sum(axis=1) <= (MOST + 1e-9) * network.length), kind
        assert not arms.length[~arms.sheared].any(), f"half a solid joint of {kind}"


def test_joints_are_continuous_in_the_thickness():
    """Some of these thicknesses lie where joints begin to fill their walls."""
    full = 0
    for thickness in np.linspace(0.4e-3, 1.4e-3, 11):
        one, two = (
            solid_joints(network_of("circle", wall_thickness=t), "glued")
            for t in (thickness, thickness * (1.0 + 1e-9))
        )
        np.testing.assert_array_equal(one.sheared, two.sheared)
        np.testing.assert_allclose(one.length, two.length, rtol=1e-7)
        np.testing.assert_allclose(one.compliance, two.compliance, rtol=1e-7)
        share = one.length.sum(axis=1) / network_of("circle", wall_thickness=thickness).length
        full += np.isclose(share.max(), MOST)
    assert 0 < full < 11


@pytest.mark.parametrize("nu", [0.0, 0.48, 0.923])
def test_joints_that_fill_their_walls_are_stable(nu):
    network = network_of("circle", wall_thickness=1.4e-3)
    arms = solid_joints(network, "contact")
    wall, side = np.nonzero(arms.length)
    x = arms.length[wall, side] / network.wall_thickness[wall]
    assert x.min() < 0.5
    assert_stable(*joint_elements(side, x, arms.compliance[wall, side], nu))


@pytest.mark.parametrize("platen", ["glued", "sliding", "contact", "none"])
def test_walls_between_the_rows_of_a_single_cell_stand_on_them(platen):
    """They end in solid joints although both their ends are in glued rows."""
    network = network_of(cells_x=2, cells_y=1)
    arms = solid_joints(network, platen)
    standing = np.ptp(network.points[network.walls][:, :, 0], axis=1) < 1e-9
    assert np.count_nonzero(standing) == 3
    assert np.all(arms.length[standing] > 0.0)
    assert arms.sheared.all()


def test_joints_of_unequal_walls_are_solid():
    network = network_of(perimeters=3, line_width=0.4e-3, wall_thickness=0.4e-3)
    assert np.ptp(network.wall_thickness) > 0.5e-3
    assert solid_joints(network, "contact").sheared.all()


def test_a_mesh_with_solid_joints():
    """A short element at either end of a wall, and equal ones between."""
    network = network_of()
    arms = solid_joints(network, "glued")
    mesh = split_walls(network, 3, 0.0, arms.length)
    standing = np.flatnonzero((arms.length > 0.0).all(axis=1))
    for wall in standing:
        own = slice(mesh.start[wall], mesh.start[wall + 1])
        np.testing.assert_array_equal(mesh.joint[own], [2 * wall, -1, -1, -1, 2 * wall + 1])
        length = mesh.rest_length[own]
        np.testing.assert_allclose(length[[0, 4]], 0.6 * 0.8e-3, rtol=1e-12)
        np.testing.assert_allclose(length[1:4], length[1], rtol=1e-12)
    total = np.bincount(mesh.wall, mesh.rest_length)
    np.testing.assert_allclose(total, network.length, rtol=1e-12)


def test_points_are_beams_without_shear():
    arms = point_joints(3)
    assert not arms.sheared.any()
    assert not arms.length.any()
    coarse = Case.of(lattice=dict(nodes_per_wall=2))
    solid, points = (
        build_scene(coarse.changed(solver=dict(joints=joints))).terms
        for joints in ("solid", "points")
    )
    assert len(points.stretch.l0) == 24 * 3 < len(solid.stretch.l0)
    np.testing.assert_allclose(points.stretch.arc, np.outer([1 / 15, -1 / 30], np.ones(72)))


def test_walls_reach_the_perimeters_of_a_slicer_as_beams():
    """Within the perimeters joints are solid; all walls are sheared."""
    lattice = lattice_with(slicer="prusa", pattern="grid", infill=0.2, width=20e-3, height=20e-3)
    network = build_network(lattice.geometry)
    arms = solid_joints(network, "glued")
    on = np.isin(network.walls, network.perimeter)
    points = network.points[network.perimeter]
    assert (((points == 0.0) | (points == 20e-3)).any(axis=1)).all()
    assert 10 < on.all(axis=1).sum() < len(on)
    np.testing.assert_array_equal(arms.length > 0.0, ~on)
    assert arms.sheared.all()
    assert len(build_network(lattice_with(perimeters=1).geometry).perimeter) == 0
