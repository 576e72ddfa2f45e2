"""Sections of any number of fibres: elastic-plastic bending of a rectangle, and rubber curves.

Closed forms: W. Prager and P. G. Hodge, Theory of Perfectly Plastic Solids, 1951, chapter 2.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from sweep.scene.material import FIBRE, OUTER, law_of_section
from tests.support.designs.tables import material_with
from tests.support.materials.memory import virgin

MODULUS, LIMIT = 2e9, 40e6
FIRST = 2.0 * LIMIT / MODULUS  # curvature x thickness at which the surface yields
YIELD_MOMENT = LIMIT / 6.0  # of a section of unit thickness and depth
FULL = 1.5 * YIELD_MOMENT
COUNTS = (5, 7, 9)


def plastic(count, hardening=0.0):
    """A section of a material that yields and does not contract, and whose faces never meet."""
    material = material_with(
        modulus=MODULUS, density=1200.0, poisson=0.0, yield_stress=LIMIT,
        hardening=hardening, bend="fibres", fibres=count,
    )  # fmt: skip
    return law_of_section(material, 1.0, 0.0)._replace(stop=0.0)


def resultants(law, strain, curvature, memory=None):
    """Force and moment of a section of unit thickness and depth."""
    memory = virgin(law.curve, law.points()) if memory is None else memory
    by_e, by_theta, _ = law.respond((strain, FIBRE * curvature, FIBRE * curvature), memory, 0)[1]
    stress = law.curve.respond(strain, memory, law.points() - 1)[1]
    return stress + 0.5 * OUTER * by_e, OUTER * FIBRE * by_theta


def moment(law, curvature, memory=None):
    return resultants(law, 0.0, curvature, memory)[1]


@pytest.mark.parametrize("count", [4, *COUNTS, 15])
def test_the_elastic_moment_is_exact(count):
    assert moment(plastic(count), 0.5 * FIRST) == pytest.approx(0.5 * YIELD_MOMENT, rel=1e-12)


def error_beyond_yield(count):
    """Greatest error of the moment up to ten times the first curvature, over the full moment."""
    ratio = np.linspace(1.0, 10.0, 181)
    exact = YIELD_MOMENT * (3.0 - ratio**-2) / 2.0
    found = [moment(plastic(count), FIRST * each) for each in ratio]
    return np.abs(found - exact).max() / FULL


@pytest.mark.parametrize(("count", "most"), [(5, 0.055), (7, 0.03), (9, 0.02), (15, 0.008)])
def test_the_moment_beyond_yield_tends_to_the_closed_form(count, most):
    assert 0.5 * most < error_beyond_yield(count) < most


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_force_and_moment_interact(share):
    """(N / N_p)^2 + M / M_p = 1 with the axis that stays straight off the middle."""
    off = []
    for count in (7, 15):
        curvature = 1e3 * FIRST
        force, moment_ = resultants(plastic(count), share * 0.5 * curvature, curvature)
        off.append(abs((force / LIMIT) ** 2 + moment_ / FULL - 1.0))
    assert 0.0 < off[1] < off[0] < 0.015
    assert off[1] < 0.004


@pytest.mark.parametrize("count", COUNTS)
def test_a_curvature_remains_after_unloading(count):
    """It is the greatest one less M / (Y I), as unloading is elastic."""
    law, greatest = plastic(count), 3.0 * FIRST
    memory, bound = virgin(law.curve, law.points()), moment(law, greatest)
    law.commit((0.0, FIBRE * greatest, FIBRE * greatest), memory, 0)
    assert moment(law, greatest, memory) == pytest.approx(bound, rel=1e-12)
    left = brentq(lambda k: moment(law, k, memory), 0.0, greatest, xtol=1e-12)
    assert left == pytest.approx(greatest - 12.0 * bound / MODULUS, rel=1e-9)
    exact = FIRST * (3.0 - (3.0 - 1.0 / 9.0) / 2.0)
    assert left == pytest.approx(exact, rel=0.02)


@pytest.mark.parametrize("hardening", [0.0, 0.1 * MODULUS])
def test_the_potential_of_a_section_is_stored_or_dissipated(hardening):
    law, lost = plastic(7, hardening), 0.0
    memory = virgin(law.curve, law.points())
    for theta in FIBRE * FIRST * np.array([2.0, 5.0, 1.0, -4.0, 0.0]):
        potential = law.respond((0.01, theta, -theta), memory, 0)[0]
        released, dissipated = law.commit((0.01, theta, -theta), memory, 0)
        assert released == pytest.approx(dissipated, rel=1e-9, abs=1e-9 * potential)
        lost += dissipated
    assert lost > 0.0


@pytest.mark.parametrize("name", ["ninjaflex", "cheetah"])
def test_more_fibres_find_the_moment_of_a_rubber(name):
    """The reference has 15 fibres; "section" has five."""
    curvatures = np.array([0.1, 0.3, 0.6])

    def moments(**keys):
        law = law_of_section(material_with(name=name, **keys), 1.0, 0.48)
        return np.array([moment(law, each) for each in curvatures])

    fine = moments(bend="fibres", fibres=15)
    off = [np.abs(moments(**keys) / fine - 1.0).max() for keys in (
        {"bend": "fibres", "fibres": 3}, {"bend": "section"}, {"bend": "fibres", "fibres": 9},
    )]  # fmt: skip
    assert off[0] < 0.05
    assert off[2] < off[1] < off[0]
    assert off[2] < 2e-3
