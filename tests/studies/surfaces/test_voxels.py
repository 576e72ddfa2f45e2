"""Moduli, nets and bricks of one period of a gyroid, each against exact numbers."""

import numpy as np
import pytest

from tests.studies.surfaces import moduli, symmetry, voxels, wall
from tests.studies.surfaces.extrapolated import limit
from tests.studies.surfaces.period import GYROID, best_period

RNG = np.random.default_rng(4)
POISSON = 0.3
PLANE = 1.0 / (1.0 - POISSON**2)


def test_an_isotropic_material_has_one_modulus():
    law = voxels.elastic(POISSON)
    of, rest = moduli.cubic(law)
    np.testing.assert_allclose(of.moduli, [1.0, 1.0, 1.0, 0.5 / 1.3], rtol=1e-12)
    assert rest < 1e-15
    law[0, 4] = 0.1 * law[0, 0]
    assert moduli.cubic(law)[1] == pytest.approx(0.1)


@pytest.mark.parametrize(("way", "row"), [((1, 0, 0), 0), ((1, 1, 0), 1), ((1, 1, 1), 2)])
def test_moduli_along_a_direction(way, row):
    """A stress n n along n: the strain n . e n it makes is 1 / E."""
    of = moduli.Cubic(3.0, 1.2, 0.4)
    law = np.diag([1.8] * 3 + [0.4] * 3)
    law[:3, :3] += 1.2
    n = np.array(way) / np.linalg.norm(way)
    stress = np.array([n[i] * n[k] for i, k in moduli.PAIRS])
    strain = moduli.tensor(np.linalg.solve(law, stress))
    assert of.moduli[row] == pytest.approx(1.0 / (n @ strain @ n), rel=1e-12)


def test_distances_are_along_the_normal():
    net = best_period(8)
    points, normals = net.points, net.normals
    away = RNG.uniform(-0.06, 0.06, len(points))
    found = wall.distance(points + away[:, None] * normals)
    np.testing.assert_allclose(found, np.abs(away), atol=1e-5)


def test_the_volume_of_a_wall():
    assert wall.density(wall.thickness_of(0.2)) == pytest.approx(0.2, rel=1e-12)
    assert voxels.solid(32, wall.thickness_of(0.3)).density == pytest.approx(0.3, rel=2e-4)


def test_symmetry_keeps_the_wall():
    members, at = symmetry.group(), RNG.uniform(size=(50, 3))
    assert len(members) == 16
    whole = np.abs(GYROID.value(2.0 * np.pi * at))
    for sign, half in members:
        moved = np.array(sign) * at + 0.5 * np.array(half)
        np.testing.assert_allclose(np.abs(GYROID.value(2.0 * np.pi * moved)), whole, atol=1e-12)


@pytest.mark.parametrize("component", [0, 3])
def test_a_sixteenth_tells_of_the_whole(component):
    columns = [
        voxels.Voxels(voxels.cubes(8, 0.1, members), members).column(component)
        for members in ([symmetry.IDENTITY], symmetry.group())
    ]
    np.testing.assert_allclose(columns[1], columns[0], atol=1e-6 * columns[0].max())
    assert columns[0].max() > 0.05


def test_the_gyroid_of_bricks_is_cubic():
    members = [symmetry.IDENTITY]
    whole = voxels.Voxels(voxels.cubes(8, 0.1, members), members)
    of, rest = moduli.cubic(np.stack([whole.column(k) for k in range(6)]))
    assert rest < 1e-6
    np.testing.assert_allclose(of, voxels.solid(8, 0.1).cubic, rtol=1e-6)


def plate_of_bricks(n, parts):
    """A flat plate normal to z, of this number of parts of cubes through its thickness."""
    level = np.arange(n * voxels.PARTS)
    full = (level >= 3) & (level < 3 + parts)
    at = np.indices((n, n, n)).reshape(3, -1).T
    height = voxels.PARTS * at[:, 2, None] + np.arange(voxels.PARTS**3) % voxels.PARTS
    shares = full[height].astype(float)
    solid = shares.any(axis=1)
    return voxels.Cubes(at[solid], shares[solid], n)


@pytest.mark.parametrize("weighted", [False, True])
def test_a_flat_plate_of_bricks_is_in_plane_stress(weighted):
    """Cut cubes too; weighted ones hold across no more than the others."""
    members, thickness = [symmetry.IDENTITY], 7 / (4 * voxels.PARTS)
    of = voxels.Voxels(plate_of_bricks(4, 7), members, POISSON, weighted)
    expected = PLANE * thickness * np.array([1.0, POISSON, 0, 0, 0, 0])
    np.testing.assert_allclose(of.column(0), expected, atol=1e-6)
    expected = 0.5 / (1.0 + POISSON) * thickness * np.array([0, 0, 0, 0, 0, 1.0])
    np.testing.assert_allclose(of.column(5), expected, atol=1e-6)


def test_bricks_tend_to_a_limit_from_above_with_order_two():
    """The other rule for cut cubes leads to the same limit."""
    of = limit(0.3, 12)
    np.testing.assert_allclose(of.order, 2.0, atol=0.2)
    assert of.error.max() < 2e-3
    assert np.all(of.rows[-1][1].cubic.moduli > of.moduli)
    found = [voxels.solid(n, of.thickness, weighted=True).cubic.moduli for n in (24, 48)]
    np.testing.assert_allclose(found[1] + (found[1] - found[0]) / 3.0, of.moduli, rtol=3e-3)


def test_a_net_of_one_period_is_closed():
    """It has the Euler characteristic -8 of a gyroid, each side lies between two quads that go
    round it in opposite directions, and normals point to one side.
    """
    net = best_period(8)
    one, two = net.quads, np.roll(net.quads, -1, axis=1)
    way = np.roll(net.shift, -1, axis=1) - net.shift
    sides = np.dstack([one, two, way]).reshape(-1, 5)
    assert len(np.unique(sides, axis=0)) == len(sides)
    back = np.column_stack([sides[:, [1, 0]], -sides[:, 2:]])
    np.testing.assert_array_equal(np.unique(sides, axis=0), np.unique(back, axis=0))
    assert len(net.points) - len(net.quads) == -8
    assert np.abs(GYROID.value(2.0 * np.pi * net.points)).max() < 1e-12
    ahead, up = net.corners[:, 2] - net.corners[:, 0], net.corners[:, 3] - net.corners[:, 1]
    assert np.all((np.cross(ahead, up) * net.normals[net.quads[:, 0]]).sum(axis=1) > 0.0)
