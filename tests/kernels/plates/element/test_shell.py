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
    mapped,
    plate,
    shaken,
    smooth,
    stored,
    surface,
    term_of,
    virgin,
)
from tests.support.kernels.terms import derivative_error

RUBBER = sheets.elastic_only(sheets.sheet_of_rubber())
MU = MODULUS / 3


def saddle(shake=0.2, grid=(2, 2)):
    """A warped patch of a saddle, with quads that are neither flat nor rectangles."""

    def place(u, v):
        return np.column_stack([u + 0.3 * v, v, 0.4 * (u - 0.5) * (v - 0.4)])

    def normal(u, v):
        slopes = np.column_stack([-0.4 * (v - 0.4), -0.4 * (u - 0.5) + 0.12 * (v - 0.4)])
        n = np.column_stack([slopes, np.ones(len(u))])
        return n / np.linalg.norm(n, axis=1)[:, None]

    return surface(grid, place, normal, shake=shake)


def flat(shake, grid=(3, 3)):
    """A skew plate in the plane of x and y, of distorted quads."""
    return surface(
        grid,
        lambda u, v: np.column_stack([1.2 * u + 0.3 * v, v, 0.0 * u]),
        lambda u, v: np.tile([0.0, 0.0, 1.0], (len(u), 1)),
        shake=shake,
    )


def turned(of: Structure, w, shift=(0.3, -0.2, 0.5)):
    """Coordinates after a rotation by the parameters w, in every frame, and a shift."""
    x = mapped(of, lambda p: np.array([rotation.turned(w, tuple(q)) for q in p]) + shift)
    for i, frame in enumerate(of.frames):
        x[6 * i + 3 : 6 * i + 6] = frame.reshape(3, 3).T @ w
    return x


LAWS = pytest.mark.parametrize("law", [LINEAR, RUBBER], ids=["linear", "rubber"])
STRUCTURES = {
    "plate": plate(),
    "joint": cross(),
    "saddle": saddle(),
    "joint bent at rest": at_rest(cross(), shaken(cross(), 5, 0.1, 0.1)),
    "small": plate(1, 1, 1e-3, 0.8e-3, 1e-4),
    "large": plate(1, 1, 1e3, 0.8e3, 1e2),
}


@LAWS
@pytest.mark.parametrize("state", [(0.0, 0.0), (0.05, 0.05), (0.2, 0.25)])
@pytest.mark.parametrize("name", STRUCTURES)
def test_derivatives(name, state, law):
    """State: size of random moves and rotations."""
    of = STRUCTURES[name]
    x = shaken(of, 1, *state)
    step, tolerance = (2e-4, 1e-9) if law is LINEAR else (1e-5, 1e-5)
    assert derivative_error(term_of(of, law), x, of.unit, step) < tolerance


def test_derivatives_after_a_large_rotation():
    of = cross()
    x = turned(of, np.array([1.5, -2.0, 0.7])) + shaken(of, 2, 0.1, 0.1) - of.rest
    assert derivative_error(term_of(of), x, of.unit, 2e-4) < 1e-9


@pytest.mark.parametrize("w", [(0.0, 0.0, 0.0), (0.1, 0.2, -0.3), (1.5, -2.0, 0.7)])
@pytest.mark.parametrize("name", ["plate", "joint", "saddle"])
def test_the_rest_shape_and_rigid_motions_cost_nothing(name, w):
    of = STRUCTURES[name]
    energy, gradient = term_of(of).energy_gradient(turned(of, np.array(w)))
    assert energy < 1e-25 * MODULUS
    np.testing.assert_allclose(gradient, 0.0, atol=1e-12 * MODULUS)


def test_any_shape_may_be_at_rest():
    bent = shaken(cross(), 5, 0.1, 0.1)
    assert stored(cross(), bent).sum() > 1e-3 * MODULUS * 0.1
    energy, gradient = term_of(STRUCTURES["joint bent at rest"]).energy_gradient(bent)
    assert energy == pytest.approx(0.0, abs=1e-25)
    np.testing.assert_allclose(gradient, 0.0, atol=1e-12)


@LAWS
@pytest.mark.parametrize(
    ("of", "f", "plane"),
    [
        (plate(3, 2, 1.2, 1.0), [[1.2, 0.0, 0.1], [0.0, 1.0, 0.0], [-0.2, 0.0, 0.9]], [0, 2]),
        (flat(0.25), [[1.2, 0.1, 0.0], [-0.2, 0.9, 0.0], [0.0, 0.0, 1.0]], [0, 1]),
    ],
    ids=["rectangles", "distorted quads"],
)
def test_uniform_stretch_is_exact(of, f, plane, law):
    """Stretch and shear in the plane of a wall of 1.2 by 1."""
    f = np.array(f)
    c = f[:, plane].T @ f[:, plane]
    expected = 0.12 * law.elastic.respond(c[0, 0] - 1, c[1, 1] - 1, c[0, 1])[0]
    membrane, bending, sheared = stored(of, mapped(of, lambda p: p @ f.T), law)
    assert membrane == pytest.approx(expected, rel=1e-12)
    assert (bending, sheared) == pytest.approx((0.0, 0.0), abs=1e-12 * expected)


def energy_per_area(of: Structure, x, law=LINEAR):
    return stored(of, x, law) / np.prod(of.walls.size, axis=1).sum()


def test_a_rigid_motion_of_a_strained_structure_changes_no_energy():
    of = at_rest(cross(), shaken(cross(), 5, 0.1, 0.0))
    w = np.array([0.4, 1.1, -0.5])
    assert stored(of, turned(of, w)) == pytest.approx(stored(of, of.rest), rel=1e-12)


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


@pytest.mark.parametrize("turn", [0.05, 0.2])
def test_elements_on_a_circle_keep_their_length(turn):
    """The chord of an arc of angle ``turn`` is short by its square / 24; the energy has an error of
    the fourth order.
    """
    of = plate(4, 1, 1.0, 0.3, 1e-3)
    number, found = 4.0 * of.points[:, 0], []
    for chord in (2.0 / turn * np.sin(0.5 * turn), 1.0):
        x, radius = of.rest, 0.125 * chord / np.sin(0.5 * turn)
        rows = x[:-2].reshape(-1, 6)
        rows[:, 0], rows[:, 1] = (
            radius * np.sin(number * turn),
            radius * (np.cos(number * turn) - 1.0),
        )
        rows[:, 4] = -np.tan(0.25 * number * turn)
        found.append(stored(of, x)[0])
    assert found[0] < 2e-2 * turn**4 * found[1] / turn**2


def test_uniform_curvature_is_exact_on_distorted_quads():
    """A cylinder, to the second order of its curvature, held across."""
    k, of = 1e-5, flat(0.25)
    x = of.rest
    rows, s = x[:-2].reshape(-1, 6), of.points[:, 0]
    rows[:, 2] += 0.5 * k * s**2
    turn = np.zeros((len(s), 3))
    turn[:, 1] = -0.25 * k * s  # about y, so that the normal leans by -k s
    rows[:, 3:] = np.einsum("nij,ni->nj", of.frames.reshape(-1, 3, 3), turn)
    expected = 0.5 * 12.0 * 0.1**3 / 12 / 0.75 * k**2 * 1.2
    assert stored(of, x).sum() == pytest.approx(expected, rel=1e-5)


def test_an_element_does_not_depend_on_its_first_corner():
    of = saddle(grid=(1, 1))
    x, whole = shaken(of, 3, 0.1, 0.1), []
    for first in range(4):
        other = smooth(
            of.points, of.frames.reshape(-1, 3, 3)[:, :, 2], np.roll(of.walls.quads, first, 1)
        )
        whole.append(stored(Structure(of.points, of.frames, other.walls), x).sum())
    np.testing.assert_allclose(whole, whole[0], rtol=1e-12)


def test_a_rectangle_is_a_special_case():
    plain = surface(
        (2, 2),
        lambda u, v: np.column_stack([1.2 * u, v, 0.0 * u]),
        lambda u, v: np.tile([0.0, 0.0, 1.0], (len(u), 1)),
    )
    walls = plain.walls
    as_flat = shell.rectangles(
        walls.quads, walls.size, walls.thickness, walls.directors, walls.shear_modulus,
        walls.fold_modulus,
    )  # fmt: skip
    x = shaken(plain, 2, 0.1, 0.1)
    flat_one = Structure(plain.points, plain.frames, as_flat)
    np.testing.assert_allclose(stored(plain, x), stored(flat_one, x), rtol=1e-12)
