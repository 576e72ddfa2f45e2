"""Sections against the exact bending of a block that keeps its volume and its depth.

A line at z across a block of thickness 1 becomes an arc of stretch l, l^2 = p + 2 kappa z, whatever
the material; p makes the energy least (R. S. Rivlin, Proc. R. Soc. A 195, 1949, p. 463). Bent and
kept at its depth, such a block has the energy H(ln l) + H(-ln l) of `kernels.laws.sheet`.
"""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

from kernels.laws import separable
from kernels.laws.elastic import FibreCurve
from kernels.terms.section import TOUCHING
from sweep.scene.material import FIBRE, OUTER, law_of_section, stress_law
from tests.support.designs.tables import material_with
from tests.support.kernels.frames import point_of
from tests.support.kernels.terms import NO_MEMORY

PLACE, WEIGHT = 0.5 * np.array(np.polynomial.legendre.leggauss(200))
NU = 0.48


def of_neo_hookean(kappa):
    """Moment of a block of W = (l^2 + l^-2) / 2: p = (1 + kappa^2)^(1/2)."""
    return (np.sqrt(1.0 + kappa**2) - np.arcsinh(kappa) / kappa) / (2.0 * kappa)


def of_block(pull, kappa):
    """Moment of a block with the Cauchy stress ``pull`` (ln l), without the stress across its
    lines.
    """

    def sums(gap):
        square = kappa + np.exp(gap) + 2.0 * kappa * PLACE
        stress = WEIGHT * pull(0.5 * np.log(square)) / square
        return stress.sum(), stress @ PLACE

    return sums(brentq(lambda gap: sums(gap)[0], -9.0, 3.0, xtol=1e-12))[1]


def of_section(law, kappa):
    """Moment of a section of thickness 1 without axial force."""

    def sums(e):
        by_e, by_theta, _ = law.respond((e, FIBRE * kappa, FIBRE * kappa), NO_MEMORY, 0)[1]
        along = law.curve.respond(e, NO_MEMORY, 0)[1]
        return along + 0.5 * OUTER * by_e, OUTER * FIBRE * by_theta

    return sums(brentq(lambda e: sums(e)[0], -0.05, 3.0, xtol=1e-12))[1]


def pull_of(name):
    """`of_block`'s stress of a shipped material, from its curve in tension and compression."""
    curve = stress_law(material_with(name=name))

    def nominal(strain):
        return curve.at(strain), (curve.at(strain + 1e-7) - curve.at(strain - 1e-7)) / 2e-7

    h = CubicHermiteSpline(*separable.rising(nominal, -0.7))
    return lambda x: h(x) - h(-x)


def neo_hookean():
    """15 fibres of W = (a^2 + a^-2) / 2 that keep their volume, and whose faces never meet."""
    knots, many = np.linspace(-0.7, 3.0, 371), law_of("ninjaflex", 15)
    rows, energy = separable.cubics(
        knots, 1.0 + knots - (1.0 + knots) ** -3, 1.0 + 3.0 * (1.0 + knots) ** -4
    )
    curve = point_of(FibreCurve(knots, rows, energy, 4.0))
    return many._replace(curve=curve, m=2.0, radial=0.0, stop=0.0)


def law_of(name, fibres=None):
    keys = {} if fibres is None else {"bend": "fibres", "fibres": fibres}
    return law_of_section(material_with(name=name, **keys), 1.0 / (1.0 - NU**2), NU / (1.0 - NU))


@pytest.mark.parametrize("kappa", [0.1, 0.5, 1.0, 2.0])
def test_a_block_of_neo_hookean_has_a_closed_form(kappa):
    found = of_block(lambda x: 2.0 * np.sinh(2.0 * x), kappa)
    assert found == pytest.approx(of_neo_hookean(kappa), rel=1e-9)


@pytest.mark.parametrize(("kappa", "within"), [(0.1, 1e-6), (1.0, 1e-6), (2.0, 1e-4), (3.0, 3e-3)])
def test_many_fibres_of_neo_hookean_bend_as_the_block(kappa, within):
    assert of_section(neo_hookean(), kappa) == pytest.approx(of_neo_hookean(kappa), rel=within)


@pytest.mark.parametrize(("name", "stiffest"), [("cheetah", 1.21), ("ninjaflex", 1.14)])
def test_sections_beside_the_block(name, stiffest):
    """They follow the curve times 1 / (1 - nu^2) at any strain, and are stiffer when bent far."""
    law, block = law_of(name), pull_of(name)
    ratios = [of_section(law, kappa) / of_block(block, kappa) for kappa in (0.1, 0.5, 1.0, 1.5)]
    assert ratios[0] == pytest.approx(1.0, abs=0.015)
    assert max(ratios) == pytest.approx(stiffest, abs=0.02)


@pytest.mark.parametrize("name", ["cheetah", "ninjaflex", "filaflex_60a"])
@pytest.mark.parametrize("fibres", [None, 7])
def test_faces_that_meet_stop_bending(name, fibres):
    """No moment falls by more than 4 %, and beyond twice the curvature it is far greater."""
    law = law_of(name, fibres)
    moment = np.array([of_section(law, each) for each in np.linspace(0.05, 4.0, 80)])
    assert (moment / np.maximum.accumulate(moment)).min() > 0.96
    free = law._replace(stop=0.0)
    meeting = TOUCHING / FIBRE
    assert of_section(free, meeting) == of_section(law, meeting)
    assert of_section(free, 2.0 * meeting) < 0.5 * moment[-1]
