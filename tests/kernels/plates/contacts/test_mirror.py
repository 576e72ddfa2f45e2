"""Contact of plates with their images beyond a mirror plane: half of that with the image itself."""

import numpy as np
import pytest

from kernels.laws.barrier import barrier
from kernels.plates.contacts import mirror
from kernels.shared.moves import ADVANCE
from sweep.scene.plates.contact import contact_of, mirror_of
from sweep.scene.plates.coordinates import Numbering, at_rest
from sweep.scene.plates.mesh import build_mesh
from tests.support.designs.plates import BOX, T, along

STIFFNESS = 4.0 / 3.0 * 19.3e6  # of ninjaflex


@pytest.fixture(scope="module")
def quarter():
    """Mesh, contact and mirror of a quarter of a tube, and its coordinates at rest."""
    case = along(cells_x=1, cells_y=1, symmetry="quarter", nodes_per_wall=5)
    mesh = build_mesh(case.lattice)
    contact = contact_of(mesh, Numbering(mesh.n_nodes), case)
    return mesh, contact, mirror_of(mesh, case), at_rest(mesh, "glued")


def near(quarter, distance):
    """Coordinates with one inner node at this distance from the mirror plane of x."""
    mesh, *_, x = quarter
    node = int(np.flatnonzero(mesh.flat & (mesh.rest[:, 0] < 1e-3 * BOX) & (mesh.level == 3))[0])
    moved = x.copy()
    moved[6 * node] = 0.5 * BOX - distance
    return node, moved


def energy(quarter, x):
    _, contact, planes, _ = quarter
    return mirror.evaluate(x, contact, planes, np.zeros_like(x))


def test_nodes_on_a_plane_and_walls_at_rest_do_not_touch(quarter):
    mesh, _, planes, x = quarter
    assert planes.node.size == 2 * mesh.n_nodes - mesh.on.sum()
    assert planes.rest.min() > 0.5 * T
    assert energy(quarter, x) == 0.0
    assert mirror.least_gap(x, planes, np.inf) == pytest.approx(planes.rest.min())


def test_energy_is_half_of_that_of_a_pair_over_the_thickness(quarter):
    mesh, contact, _, _ = quarter
    node, x = near(quarter, 0.2 * T)
    value, _, _ = barrier(2.0 * 0.2)
    pair = mesh.area[node] * STIFFNESS * T * value
    assert contact.stiffness == pytest.approx(STIFFNESS)
    assert energy(quarter, x) == pytest.approx(0.5 * pair)


@pytest.mark.parametrize("distance", [0.49, 0.3, 0.1])
def test_slope_and_curvature_are_those_of_the_energy(quarter, distance):
    _, contact, planes, _ = quarter
    node, x = near(quarter, distance * T)
    g, step = np.zeros_like(x), 1e-5 * T
    mirror.evaluate(x, contact, planes, g)
    place = int(np.flatnonzero(planes.coordinate == 6 * node)[0])
    low, high = x.copy(), x.copy()
    low[6 * node] -= step
    high[6 * node] += step
    slope = (energy(quarter, high) - energy(quarter, low)) / (2.0 * step)
    assert g[6 * node] == pytest.approx(slope, rel=1e-6)
    assert np.count_nonzero(g) == 1
    slopes = [mirror.against(at, contact, planes, place)[1] for at in (high, low)]
    _, _, curvature = mirror.against(x, contact, planes, place)
    assert curvature == pytest.approx((slopes[1] - slopes[0]) / (2.0 * step), rel=1e-6)


def test_no_step_reaches_the_plane(quarter):
    _, _, planes, x = quarter
    _, there = near(quarter, 0.0)
    half = 0.5 * (there - x)
    assert mirror.step_limit(x, half, planes, 1.0) == pytest.approx(1.0)
    assert mirror.step_limit(x, 4.0 * half, planes, 1.0) == pytest.approx(0.5 * ADVANCE)
    assert mirror.step_limit(x, -4.0 * half, planes, 1.0) == 1.0


def test_whole_lattices_and_scenes_without_contact_have_no_mirror():
    case = along(cells_x=1, cells_y=1)
    assert mirror_of(build_mesh(case.lattice), case).node.size == 0
