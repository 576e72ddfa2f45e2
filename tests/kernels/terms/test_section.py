"""Bent sections: stretch of fibres, the law and its derivatives, elements that bend through it."""

import numpy as np
import pytest

from kernels.terms import section
from kernels.terms.section import fibre, stop
from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError
from sweep.scene.lattice import build_scene
from sweep.scene.material import FIBRE, law_of_section
from tests.support.designs.tables import material_with
from tests.support.kernels.frames import (
    MODULUS,
    Frame,
    fibre_of,
    frame,
    joint_of_four,
    linear_law,
    point_of,
    scaled,
    section_of,
    sections_of,
    shaken,
    stretch_of,
    walls_of,
)
from tests.support.kernels.terms import (
    NO_MEMORY,
    bending_of,
    derivative_error,
    difference,
    differences,
    law_errors,
    least_share,
)

NAMES = ["ninjaflex", "cheetah", "filaflex_60a"]
FRAME = joint_of_four()
WALL = frame([(0, 0), (2.0, 0)], [(0, 1)], 2)
PLANES = [0.48, 0.48 / 0.52]  # nu' in plane stress and in plane strain
STRAINS = [
    (0.0, 0.0, 0.0),
    (0.0, 0.2, -0.1),
    (-0.1, 0.0, 0.3),
    (-0.3, -0.25, 0.25),
    (0.2, 0.5, -0.6),
    (0.2, 0.85, -0.9),  # beyond the stop, with crushed fibres
]


def law(name="ninjaflex", nu=0.48):
    return law_of_section(material_with(name=name), MODULUS / 19.3e6, nu)


def plain(nu=0.0, radial=0.0):
    """Fibres of a linear curve."""
    return section_of(fibre_of(linear_law(MODULUS)), 1.0 + nu, radial)


def stretch(nu, q):
    """The stretch of a fibre and its two derivatives in q."""
    return fibre(plain(nu), q, max(q, 0.0) ** (1.0 / (1.0 + nu)))


def term_of(of: Frame, through, cubic=True):
    return bending_of(walls_of(of), sections_of(of, through, cubic), along=stretch_of(of))


def test_an_elastic_section_is_one_whose_memory_is_empty():
    """Sections with and without memory are compiled separately."""
    general = law()._replace(curve=law().curve._replace(is_elastic=False))
    assert difference(term_of(FRAME, law()), term_of(FRAME, general), shaken(FRAME, 0, 0.1)) < 1e-12


@pytest.mark.parametrize("nu", PLANES)
@pytest.mark.parametrize("stretched", [1.0, 0.8, 1.3])
def test_a_fibre_is_stretched_as_its_section_thins(nu, stretched):
    """dy/dz = a^(-nu') with a = lambda + kappa y: the slope of a over z is kappa a^(-nu')."""
    m, kappa, z = 1.0 + nu, 0.3, np.linspace(-0.5, 0.5, 7)
    a, by_q, _ = np.array([stretch(nu, stretched**m + m * kappa * each) for each in z]).T
    np.testing.assert_allclose(m * kappa * by_q, kappa * a**-nu, rtol=1e-12)
    assert a[3] == pytest.approx(stretched, rel=1e-14)


@pytest.mark.parametrize("nu", [0.0, *PLANES, 1.0])
def test_derivatives_of_the_stretch_of_a_fibre(nu):
    """A crushed fibre, and one with a negative q, too; C2 where it begins to be crushed."""
    m = 1.0 + nu
    least = section.CRUSHED**m
    for q in (-0.5, 0.0, 0.5 * least, 2.0 * least, 1.0, 4.0):
        rows = differences(lambda x: np.array(stretch(nu, x[0])), np.array([q]), np.array([1e-4]))
        np.testing.assert_allclose(rows[0, :2], stretch(nu, q)[1:], rtol=1e-6, atol=1e-8)
    below, above = (np.array(stretch(nu, least * (1.0 + side))) for side in (-1e-9, 1e-9))
    np.testing.assert_allclose(below, above, rtol=1e-7, atol=1e-12)


def test_the_stop_begins_where_faces_meet():
    """At a turn of 2 / t per length, continuously, and as stiff as linear bending at twice that."""
    assert pytest.approx(2.0 * FIBRE, rel=1e-15) == section.TOUCHING
    assert stop(section.TOUCHING) == (0.0, 0.0, 0.0)
    near = 1e-6
    assert np.all(np.abs(stop(-section.TOUCHING - near)) < 3.0 * near)
    linear = plain().respond((0.0, 0.0, 0.0), NO_MEMORY, 0)[2][3]
    assert MODULUS * stop(2.0 * section.TOUCHING)[2] == pytest.approx(linear, rel=1e-12)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("nu", PLANES)
@pytest.mark.parametrize("strain", STRAINS)
def test_the_law_has_its_derivatives(name, nu, strain):
    through, x = law(name, nu), np.add(strain, [1e-4, 2e-4, 3e-4])  # off the knots
    errors = law_errors(lambda *x: through.respond(x, NO_MEMORY, 0), x, 2e-6)
    assert errors[0] < 1e-7 * MODULUS
    assert errors[1] < 2e-4 * MODULUS
    value = through.respond(tuple(x), NO_MEMORY, 0)[0]
    assert through.commit(tuple(x), NO_MEMORY, 0) == pytest.approx((0.0, 0.0), abs=1e-12 * value)


@pytest.mark.parametrize("nu", PLANES)
@pytest.mark.parametrize("e", [-0.2, 0.0, 0.15])
def test_stiffness_of_a_stretched_section(nu, e):
    """D = I lambda^(2 - 2 m) (W'' + (1 - m) W' / lambda): a squeezed wall is thicker."""
    m, stretched = 1.0 + nu, 1.0 + e
    through = plain(nu, radial=3.0)
    tangent = through.respond((e, 0.0, 0.0), NO_MEMORY, 0)[2]
    bending = stretched ** (2.0 - 2.0 * m) * MODULUS * (1.0 + (1.0 - m) * e / stretched)
    assert tangent[3] == pytest.approx(2.0 * bending, rel=1e-12)
    assert tangent[3] == tangent[5]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("seed", range(2))
def test_derivatives_in_random_states(seed, name):
    x = shaken(FRAME, seed, 0.3)
    assert derivative_error(term_of(FRAME, law(name)), x, FRAME.unit, 1e-6) < 1e-5


@pytest.mark.parametrize(
    ("turn", "length"), [(0.0, 1.0), (1e-6, 1.0), (-0.5, 1.0), (1.5, 1.0), (1.5, 1e-3)]
)
@pytest.mark.parametrize("cubic", [True, False])
def test_derivatives_of_a_bent_wall(turn, length, cubic):
    of = scaled(WALL, length)
    through = plain(0.48, 0.5)
    through = through._replace(curve=fibre_of(linear_law(of.modulus)), radial=0.5 * of.modulus)
    x = of.rest.copy()
    x[2:4] = length * np.array([1.0 + 1.2 * np.cos(turn), 1.2 * np.sin(turn)])
    x[6:9] = 0.3 * turn, 0.3 * turn, 0.5 * turn
    assert derivative_error(term_of(of, through, cubic), x, of.unit, 1e-4) < 1e-6


@pytest.mark.parametrize("seed", range(2))
def test_projected_hessian_is_semi_definite(seed):
    """It is so where the moment falls, too."""
    x = shaken(FRAME, seed, 0.5)
    falling = law()
    curve = falling.curve.relaxing.elastic.curve
    coefficients = curve.coefficients.copy()
    coefficients[np.abs(curve.knots[:-1]) > 0.1] *= -1.0
    falling = falling._replace(curve=point_of(curve._replace(coefficients=coefficients)))
    assert least_share(term_of(FRAME, law()), x, FRAME.unit) > -1e-12
    assert least_share(term_of(FRAME, falling), x, FRAME.unit) > -1e-12
    assert np.linalg.eigvalsh(term_of(FRAME, falling).hessian(x))[0] < -1.0


def test_a_wall_squeezed_to_nothing_has_infinite_energy():
    x = WALL.rest.copy()
    x[4:6] = 1e-3, 0.0
    x[2:4] = 0.02, 0.0
    x[4] = 0.04
    assert term_of(WALL, law()).energy(x) == np.inf
    assert section.LEAST == 0.05


@pytest.mark.parametrize("plane", ["strain", "stress", "strain_bending"])
@pytest.mark.parametrize(
    ("element", "joints"), [("cubic", "solid"), ("cubic", "points"), ("classical", "points")]
)
def test_sections_of_a_scene_are_its_beams(plane, element, joints):
    """With a linear curve the Hessian at rest equals the Hessian of linear bending, shear
    included.
    """
    built = build_scene(Case.of(
        lattice=dict(nodes_per_wall=2),
        material=dict(plane=plane, bend="section"),
        solver=dict(element=element, joints=joints),
    ))  # fmt: skip
    terms, x = built.terms, built.x_rest
    modulus = built.terms.bend.section.curve.modulus
    curve = fibre_of(linear_law(modulus))
    through = terms.bend._replace(section=terms.bend.section._replace(curve=curve))
    linear = terms.bend._replace(volume=np.zeros_like(terms.bend.volume))
    one, two = (
        bending_of(terms.walls, bending, along=terms.stretch).hessian(x)
        for bending in (linear, through)
    )
    np.testing.assert_allclose(two, one, rtol=0, atol=1e-12 * np.abs(one).max())
    assert np.count_nonzero(terms.bend.volume) == 24 * 3


def test_section_bending_needs_a_curve_and_has_no_measure():
    with pytest.raises(RefusedError, match=r"material\.bend = section; allowed: \"linear\""):
        material_with(modulus=1e6, density=1e3, bend="section")
    with pytest.raises(RefusedError, match=r"bend_measure = tangent; allowed: \"angle\""):
        Case.of(solver=dict(bend_measure="tangent"))
