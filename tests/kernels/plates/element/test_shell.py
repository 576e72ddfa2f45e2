"""Shells: derivatives, rigid motions, uniform strains and curvatures, joints, rest shapes."""

import numpy as np
import pytest

from kernels.plates.element import rotation, shear, shell
from tests.support.kernels import sheets
from tests.support.kernels.shells import (
    LINEAR,
    MODULUS,
    Structure,
    at_rest,
    cross,
    element_hessians,
    mapped,
    plate,
    shaken,
    stored,
    term_of,
    virgin,
)
from tests.support.kernels.terms import derivative_error

RUBBER = sheets.elastic_only(sheets.sheet_of_rubber())
STATES = [(0.0, 0.0), (0.05, 0.05), (0.2, 0.3)]  # size of random moves and rotations
MU = MODULUS / 3


def turned(of: Structure, w, shift=(0.3, -0.2, 0.5)):
    """Coordinates after a rotation by the parameters w, in every frame, and a shift."""
    x = mapped(of, lambda p: np.array([rotation.turned(w, tuple(q)) for q in p]) + shift)
    for i, frame in enumerate(of.frames):
        x[6 * i + 3 : 6 * i + 6] = frame.reshape(3, 3).T @ w
    return x


def energy_per_area(of: Structure, x, law=LINEAR):
    return stored(of, x, law) / np.prod(of.walls.size, axis=1).sum()


@pytest.mark.parametrize("law", [LINEAR, RUBBER], ids=["linear", "rubber"])
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("of", [plate(), cross()], ids=["plate", "joint"])
def test_derivatives(of, state, law):
    x = shaken(of, 1, *state)
    step, tolerance = (2e-4, 1e-9) if law is LINEAR else (1e-5, 1e-5)
    assert derivative_error(term_of(of, law), x, of.unit, step) < tolerance


def test_derivatives_after_a_large_rotation():
    of = cross()
    x = turned(of, np.array([1.5, -2.0, 0.7])) + shaken(of, 2, 0.1, 0.1) - of.rest
    assert derivative_error(term_of(of), x, of.unit, 2e-4) < 1e-9


@pytest.mark.parametrize("length", [1e-3, 1e3])
def test_derivatives_in_other_units(length):
    of = plate(1, 1, length, 0.8 * length, 0.1 * length)
    x = shaken(of, 3, 0.1, 0.1)
    assert derivative_error(term_of(of), x, of.unit, 2e-4) < 1e-9


def test_derivatives_of_a_wall_that_is_bent_at_rest():
    of = at_rest(cross(), shaken(cross(), 5, 0.1, 0.1))
    x = shaken(of, 6, 0.1, 0.15)
    assert derivative_error(term_of(of), x, of.unit, 2e-4) < 1e-9


def test_a_shape_at_rest_is_free_of_energy_and_stress():
    bent = shaken(cross(), 5, 0.1, 0.1)
    of = at_rest(cross(), bent)
    assert stored(cross(), bent).sum() > 1e-3 * MODULUS * 0.1
    energy, gradient = term_of(of).energy_gradient(bent)
    assert energy == pytest.approx(0.0, abs=1e-25)
    np.testing.assert_allclose(gradient, 0.0, atol=1e-12)


@pytest.mark.parametrize("w", [(0.0, 0.0, 0.0), (0.1, 0.2, -0.3), (1.5, -2.0, 0.7)])
@pytest.mark.parametrize("of", [plate(), cross()], ids=["plate", "joint"])
def test_rigid_motions_cost_nothing(of, w):
    energy, gradient = term_of(of).energy_gradient(turned(of, np.array(w)))
    assert energy < 1e-25 * MODULUS
    np.testing.assert_allclose(gradient, 0.0, atol=1e-13 * MODULUS)


def test_a_rigid_motion_of_a_strained_structure_changes_no_energy():
    of = at_rest(cross(), shaken(cross(), 5, 0.1, 0.0))
    w = np.array([0.4, 1.1, -0.5])
    assert stored(of, turned(of, w)) == pytest.approx(stored(of, of.rest), rel=1e-12)


def test_a_commit_changes_no_energy():
    of = cross()
    x = shaken(of, 4, 0.1, 0.25)
    frames, committed = of.frames.copy(), x.copy()
    rotation.rebase(frames, committed)
    after = stored(Structure(of.points, frames, of.walls), committed)
    assert after == pytest.approx(stored(of, x), rel=1e-12)


@pytest.mark.parametrize("law", [LINEAR, RUBBER], ids=["linear", "rubber"])
def test_uniform_stretch_is_exact(law):
    """Principal stretches a and b of a wall in the plane of x and z, and shear in that plane."""
    f = np.array([[1.2, 0.0, 0.1], [0.0, 1.0, 0.0], [-0.2, 0.0, 0.9]])
    of = plate(3, 2, 1.5, 0.8)
    c = f[:, [0, 2]].T @ f[:, [0, 2]]
    expected = 0.1 * law.elastic.respond(c[0, 0] - 1, c[1, 1] - 1, c[0, 1])[0]
    membrane, bending, sheared = energy_per_area(of, mapped(of, lambda p: p @ f.T), law)
    assert membrane == pytest.approx(expected, rel=1e-12)
    assert (bending, sheared) == pytest.approx((0.0, 0.0), abs=1e-12 * expected)


def test_uniform_shear_through_the_thickness_is_exact():
    """All directors lean by the same angle, to first order g."""
    of, w = plate(3, 2, 1.5, 0.8), np.array([0.02, -0.03, 0.0])
    x = of.rest
    x[:-2].reshape(-1, 6)[:, 3:] = w
    d = rotation.turned(w, (0.0, 0.0, 1.0))
    size = of.walls.size[0]
    k = shear.stiffnesses(5 / 6 * MU, 0.1, size, 1.0)
    expected = 0.5 * (k[0] * d[0] ** 2 + k[1] * d[1] ** 2)
    membrane, bending, sheared = energy_per_area(of, x)
    assert sheared == pytest.approx(expected, rel=1e-12)
    assert (membrane, bending) == pytest.approx((0.0, 0.0), abs=1e-25)


def curved(of: Structure, curvature):
    """Coordinates of a quadratic surface with the small ``curvature`` (2, 2) and its normals."""
    s, z = of.points[:, 0], of.points[:, 2]
    x = of.rest
    rows = x[:-2].reshape(-1, 6)
    plane = np.column_stack([s, z])
    slope = plane @ curvature
    rows[:, 1] += 0.5 * np.einsum("ni,ni->n", slope, plane)  # along -n
    rows[:, 3], rows[:, 4] = -0.25 * slope[:, 1], 0.25 * slope[:, 0]
    return x


@pytest.mark.parametrize("ratio", [(1.0, 0.0, 0.0), (1.0, -0.5, 0.0), (1.0, 1.0, 0.0), (0, 0, 1)])
def test_uniform_curvature_is_exact_to_the_second_order(ratio):
    """Cylinder held across and free (k22 = -nu k11), dome, twist: the energy of a thin plate."""
    k11, k22, k12 = 1e-5 * np.array(ratio, float)
    of = plate(3, 4, 1.5, 0.8)
    x = curved(of, np.array([[k11, k12], [k12, k22]]))
    d = MODULUS * 0.1**3 / 12 / 0.75
    expected = 0.5 * d * (k11**2 + k22**2 + k11 * k22 + k12**2)
    membrane, bending, sheared = energy_per_area(of, x)
    assert bending == pytest.approx(expected, rel=1e-5)
    assert sheared == pytest.approx(0.0, abs=1e-6 * expected)
    assert membrane == pytest.approx(0.0, abs=1e-5 * expected)


def test_element_hessians_are_symmetric():
    of = cross()
    for one in element_hessians(of, shaken(of, 7, 0.2, 0.25)):
        np.testing.assert_allclose(one, one.T, rtol=0, atol=1e-13 * np.abs(one).max())


def test_a_plate_at_rest_has_only_the_motions_that_cost_nothing():
    """Six rigid motions, and a rotation of each node about its director."""
    of = plate(2, 1)
    n = 6 * len(of.points)
    unit = of.unit[:n]
    values = np.linalg.eigvalsh(term_of(of).hessian(of.rest)[:n, :n] * np.outer(unit, unit))
    free = np.sum(values < 1e-9 * values[-1])
    assert free == 6 + len(of.points)
    assert values[0] > -1e-12 * values[-1]


def test_a_joint_turns_all_its_walls():
    """A turn by an angle about its line costs D angle^2 / (2 l) per height in each wall of length
    l.
    """
    of = cross()
    x, angle = of.rest, 1e-3
    for i in (0, len(of.points) // 2):
        x[6 * i + 5] = np.tan(0.25 * angle)
    d, height = MODULUS * 0.1**3 / 12 / 0.75, 0.8
    expected = np.sum(0.5 * d * angle**2 / of.walls.size[:, 0]) * height
    assert stored(of, x)[1] == pytest.approx(expected, rel=1e-5)


def test_a_wall_without_area_takes_infinite_energy():
    of = plate(1, 1)
    x = mapped(of, lambda p: p * np.array([0.0, 1.0, 1.0]))
    room, g = shell.make_scratch(), np.zeros_like(x)
    memory, parts = virgin(of, LINEAR), np.zeros(3)
    assert shell.evaluate(x, of.frames, of.walls, LINEAR, memory, room, g, parts) == np.inf
