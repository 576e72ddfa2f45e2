"""The bow of upright walls: in the shape in which they buckle, or drawn by a seed."""

import numpy as np
import pytest

from sweep.scene.plates.imperfection import amplitudes, bow, half_waves
from sweep.scene.plates.mesh import build_mesh
from tests.support.designs.plates import BOX, T, along


def plan_and_lattice(**lattice):
    case = along(**lattice)
    return build_mesh(case.lattice).plan, case.lattice


def test_half_waves_are_as_high_as_walls_are_long():
    assert half_waves(plan_and_lattice()[0], BOX) == 3
    assert half_waves(plan_and_lattice(symmetry="quarter")[0], BOX) == 3
    assert half_waves(plan_and_lattice(cells_x=1, cells_y=1)[0], 5e-3) == 1


def test_without_a_seed_walls_bow_in_one_wave_with_the_signs_of_buckling():
    plan, lattice = plan_and_lattice(imperfection=0.5)
    found = amplitudes(plan, lattice)
    assert found[:, :2] == pytest.approx(0.0)
    assert found[:, 2] == pytest.approx(0.5 * T * plan.sign)


def test_bow_is_a_product_of_sines_and_zero_at_all_edges():
    wave = np.array([[0.0, 0.0, 2.0]])
    at = bow(wave.repeat(4, 0), np.array([0.5, 0.25, 0.0, 0.5]), np.array([0.5, 1 / 6, 0.5, 1.0]))
    assert at == pytest.approx([-2.0, 2.0 * 0.5**0.5, 0.0, 0.0])


def test_seed_draws_another_shape_of_the_same_size():
    """The mean square of normal numbers over 24 walls and 6 waves equals the value of one wave, a^2
    / 2.
    """
    plan, lattice = plan_and_lattice(imperfection=0.1, imperfection_seed=1)
    found, again = amplitudes(plan, lattice), amplitudes(plan, lattice)
    other = amplitudes(*plan_and_lattice(imperfection=0.1, imperfection_seed=2))
    assert np.array_equal(found, again)
    assert not np.allclose(found, other)
    assert np.sqrt((found**2).sum(axis=1).mean()) == pytest.approx(0.1 * T, rel=0.2)


def test_mesh_is_bowed_by_the_amplitude_beside_flat_walls():
    flat, bowed = (build_mesh(along(imperfection=size).lattice) for size in (0.0, 0.5))
    shift = np.linalg.norm(bowed.rest - flat.rest, axis=1)
    assert shift.max() == pytest.approx(0.5 * T, rel=1e-12)
    fixed = np.isin(np.arange(flat.n_nodes), [*flat.bottom, *flat.top]) | ~flat.flat
    assert shift[fixed].max() < 1e-15


def test_arms_of_a_joint_turn_alike():
    """Beside a joint all arms are bent to the same side, seen along the arm; to first order."""
    mesh = build_mesh(along(imperfection=0.5).lattice)
    plan, layers = mesh.plan, mesh.layers
    joint = np.flatnonzero(np.bincount(plan.walls.ravel()) == 4)[0]
    level = layers // 2
    centre = mesh.rest[joint * (layers + 1) + level]
    near = mesh.quads[(mesh.quads == joint * (layers + 1) + level).any(axis=1)]
    nodes = {int(n) for n in near.ravel() if mesh.level[n] == level} - {
        joint * (layers + 1) + level
    }
    arms = np.array([mesh.rest[n] - centre for n in sorted(nodes)])[:, :2]
    axes = np.round(arms / np.linalg.norm(arms, axis=1)[:, None])
    turned = axes[:, 0] * arms[:, 1] - axes[:, 1] * arms[:, 0]
    assert len(arms) == 4
    assert turned == pytest.approx(np.full(4, turned[0]), rel=1e-9)
    assert abs(turned[0]) > 1e-6
