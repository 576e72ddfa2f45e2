"""Bending through the measured curve: the integral over the thickness, and its derivatives."""

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.integrate import quad

from kernels.terms import bend
from kernels.terms.elastic import curve, respond
from sweep.config.case import Case, Lattice, Loading, Material, Solver
from sweep.design.lattice import build_network
from sweep.scene.bending import build_bend
from sweep.scene.material import as_law, law_in_bending, section_law, stress_law
from sweep.scene.mesh import split_walls
from tests.support.frames import (
    Frame,
    bend_of,
    frame,
    joint_of_four,
    scaled,
    shaken,
    walls_of,
)
from tests.support.scenes import at, is_sound, run, unbalanced
from tests.support.terms import NO_MEMORY, bending_of, derivative_error, differences, least_share

MEASURES = [bend.ANGLE, bend.TANGENT]
NAMES = ["ninjaflex", "cheetah", "filaflex_60a"]
FRAME = joint_of_four()
HINGE = frame([(0, 0), (2.0, 0)], [(0, 1)], 2)


def table(name="ninjaflex"):
    """U' over surface strain of a material."""
    material = Material(name=name, bend="section")
    return law_in_bending(material)


def through(of: Frame, measure=bend.ANGLE, name="ninjaflex", thickness=None, cubic=True):
    """Bending of a frame through the curve of a material."""
    surface = 0.5 * (of.thickness if thickness is None else np.full(len(of.l0), thickness)) / of.l0
    weight = 0.5 * of.rigidity / of.l0 / surface**2
    return bend_of(of, measure, cubic)._replace(
        section=table(name), surface=surface, weight=np.tile(weight, (2, 1))
    )


def term_of(of, bending):
    return bending_of(walls_of(of), bending)


def moment(material, strain):
    """3/2 of the integral of sigma(strain eta) eta over eta in -1..1, by adaptive quadrature."""
    law = as_law(stress_law(material), 1.0, material.modulus)
    inside = [k / strain for k in law.knots if 0.0 < abs(k) < strain]

    def density(eta):
        return respond(law, strain * eta, NO_MEMORY, 0)[1] * eta

    found = quad(density, -1.0, 1.0, points=inside or None, limit=1000, epsabs=1e-6)
    return 1.5 * found[0]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("strain", [1e-4, 0.004, 0.01, 0.03, 0.09, 0.237, 0.45, 0.6999])
def test_the_table_is_the_integral_over_the_thickness(name, strain):
    material = Material(name=name, bend="section")
    found = material.modulus * curve(table(name), strain)[1]
    assert found == pytest.approx(moment(material, strain), rel=1e-6)


def test_a_linear_curve_bends_linearly():
    """A straight record, in compression too, gives back s, and its own modulus."""
    strain = (-0.7, -0.35, 0.01, 0.5, 1.0)
    line = {"curve_strain": strain, "curve_stress": tuple(5e6 * e for e in strain)}
    material = Material(name="line", bend="section", modulus=5e6, density=1e3, poisson=0.4, **line)
    law = as_law(section_law(material), 1.0 / material.modulus, material.modulus)
    for s in (0.0, 1e-3, 0.2, 0.7, 1.5):
        assert curve(law, s) == pytest.approx((0.5 * s * s, s, 1.0), rel=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_moment_and_rigidity_are_derivatives_of_the_energy(name):
    """At zero, at every knot and beyond the table."""
    law = table(name)
    strains = np.concatenate([[0.0, 3e-5], law.knots, [0.8, 1.2]])
    for strain in np.concatenate([strains, -strains, strains + 3e-4]):
        at, step = np.array([strain]), np.array([6e-6])
        found = law.respond(strain, NO_MEMORY, 0)
        parts = [
            differences(lambda e, i=i: law.respond(e[0], NO_MEMORY, 0)[i], at, step)[0]
            for i in (0, 1)
        ]
        np.testing.assert_allclose(found[1:], parts, rtol=0, atol=2e-4)
        assert law.respond(-strain, NO_MEMORY, 0) == pytest.approx(
            (found[0], -found[1], found[2]), rel=1e-12
        )


def test_beyond_the_table_the_last_tangent_continues():
    law = table()
    at, beyond = curve(law, law.knots[-1]), curve(law, law.knots[-1] + 0.2)
    assert law.knots[-1] == 0.7
    assert beyond[1:] == pytest.approx((at[1] + 0.2 * at[2], at[2]), rel=1e-12)


@pytest.mark.parametrize("length", [1.0, 1e-3, 1e3])
@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("turn", [0.0, 1e-6, -0.5, 1.5, 2.5, -2.9])
def test_derivatives_of_a_bent_wall(turn, measure, length):
    of = scaled(HINGE, length)
    x = of.rest.copy()
    x[2:4] = length * np.array([1.0 + 1.2 * np.cos(turn), 1.2 * np.sin(turn)])
    x[6:9] = 0.3 * turn, 0.3 * turn, 0.5 * turn
    step = 1e-4 if abs(turn) > 0.1 else 1e-6  # the third derivative jumps where a wall is straight
    assert derivative_error(term_of(of, through(of, measure)), x, of.unit, step) < 1e-6


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(4))
def test_derivatives_in_random_states(seed, measure):
    x = shaken(FRAME, seed, 0.3)
    assert derivative_error(term_of(FRAME, through(FRAME, measure)), x, FRAME.unit, 1e-5) < 1e-6


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(4))
def test_projected_hessian_is_semi_definite(seed, measure):
    """Where the moment falls, too."""
    x, bending = shaken(FRAME, seed, 0.5), through(FRAME, measure)
    falling = bending.section.coefficients.copy()
    falling[bending.section.knots[:-1] > 0.3] *= -1.0
    steep = bending._replace(section=bending.section._replace(coefficients=falling))
    assert least_share(term_of(FRAME, bending), x, FRAME.unit) > -1e-12
    assert least_share(term_of(FRAME, steep), x, FRAME.unit) > -1e-12
    assert np.linalg.eigvalsh(term_of(FRAME, steep).hessian(x))[0] < -1.0


@pytest.mark.parametrize("cubic", [True, False])
@pytest.mark.parametrize("radius", [0.4, 0.6, 1.0, 4.0])
@pytest.mark.parametrize("pieces", [8, 32])
def test_a_strip_bent_to_a_circle(pieces, radius, cubic):
    """Pure bending: every section bears b t^2 / 4 m(t / 2R), whatever the mesh."""
    thickness, length = 0.5, 2.0
    of = frame([(0, 0), (length, 0)], [(0, 1)], pieces)
    material = Material(bend="section")
    bending = through(of, thickness=thickness, cubic=cubic)
    turn = length / pieces / radius  # of every element; half of it at either end
    bearing = turn * (np.arange(pieces) + 0.5)
    steps = length / pieces * np.column_stack([np.cos(bearing), np.sin(bearing)])
    along = np.concatenate([[(0.0, 0.0)], np.cumsum(steps, axis=0)])
    x, n = of.rest.copy(), pieces + 1
    ordered = np.r_[0, np.arange(2, n), 1]
    x[: 2 * n].reshape(-1, 2)[ordered] = along
    x[2 * n : 3 * n][ordered] = turn * np.arange(n)
    strain = 0.5 * thickness / radius
    rigidity = of.rigidity[0]
    expected = rigidity * moment(material, strain) / material.modulus / (0.5 * thickness)
    gradient = term_of(of, bending).gradient(x)
    np.testing.assert_allclose(gradient[2 * n : 2 * n + 2], [-expected, expected], rtol=1e-6)
    gradient[2 * n : 2 * n + 2] = 0.0
    np.testing.assert_allclose(gradient, 0.0, atol=1e-8 * expected)


@pytest.mark.parametrize("cubic", [True, False])
@pytest.mark.parametrize("seed", range(3))
def test_the_points_integrate_linear_bending_exactly(seed, cubic):
    line = bend_of(FRAME).section
    x, plain = shaken(FRAME, seed, 0.3), bend_of(FRAME, cubic=cubic)
    points = through(FRAME, cubic=cubic)._replace(section=line)
    one, two = (term_of(FRAME, bending) for bending in (plain, points))
    assert two.energy(x) == pytest.approx(one.energy(x), rel=1e-12)
    np.testing.assert_allclose(two.hessian(x), one.hessian(x), rtol=0, atol=1e-9)


@pytest.mark.parametrize("plane", ["strain", "stress", "strain_bending"])
@pytest.mark.parametrize("element", ["cubic", "classical"])
def test_surface_strain_and_weights_of_a_scene(plane, element):
    """C = t / 2h; weights are those of linear bending."""
    lattice, t, h = Lattice(nodes_per_wall=2), 0.8e-3, 12.5e-3 / 9
    mesh = split_walls(build_network(lattice.geometry), 3, 0.0)
    linear, section = (
        build_bend(mesh, np.ones(len(mesh.edges)), Case(
            lattice=lattice, material=Material(bend=kind, plane=plane),
            solver=Solver(element=element),
        ))
        for kind in ("linear", "section")
    )  # fmt: skip
    assert linear.surface.size == linear.weight.size == 0
    np.testing.assert_allclose(section.surface, np.full(72, t / (2 * h)), rtol=1e-9)
    np.testing.assert_array_equal(section.stiffness, linear.stiffness)
    rows = section.points * section.surface[0]
    k11, k12, k22 = np.einsum("p,pi,pj->ij", section.weight[:, 0], rows, rows)[[0, 0, 1], [0, 1, 1]]
    np.testing.assert_allclose([k11, k12, k22], linear.stiffness[:, 0], rtol=1e-12, atol=1e-9)


def crushed(kind, **material):
    return run(Case(material=Material(bend=kind, **material), loading=Loading(strain=0.6)))


def test_a_crush_through_the_curve():
    """Stiffer while strains are small, softer once walls have folded: ninjaflex softens."""
    linear, section = crushed("linear"), crushed("section")
    for result in (linear, section):
        assert is_sound(result)
        assert unbalanced(result.history) < 1e-6
    early, late = (at(section, strain) / at(linear, strain) for strain in (0.051, 0.501))
    assert early == pytest.approx(1.063, abs=0.005)
    assert late == pytest.approx(0.928, abs=0.005)


def test_section_bending_of_linear_walls():
    """Each of the two may go by the curve without the other."""
    result = crushed("section", stretch="linear")
    assert is_sound(result)
    assert result.summary["absorbed_energy_J"] != crushed("section").summary["absorbed_energy_J"]


def test_section_bending_needs_a_curve():
    with pytest.raises(ValidationError, match=r"material\.bend = section; allowed: \"linear\""):
        Material(modulus=1e6, density=1e3, bend="section")
