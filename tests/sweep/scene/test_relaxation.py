"""Branches of a power law: the modulus over time, the loss of a strip, the reference time."""

import numpy as np
import pytest

from kernels.laws.relaxation import _square
from sweep.scene.material import law_in_stretch, law_of_hinge, law_of_section, stress_law
from sweep.scene.relaxation import ELASTIC, exponent, lost_share, power_law, relaxation_of
from tests.support.designs.tables import material_with
from tests.support.materials.memory import follow, prepare, relaxing, virgin

LOSSES = [0.1, 0.2, 0.3, 0.4, 0.45]
STRIP = material_with(modulus=12e6, density=1190.0, loss=0.3)


@pytest.mark.parametrize("loss", LOSSES)
def test_the_modulus_falls_as_a_power_of_time(loss):
    """Within 1.4 % from 0.1 ms to 100 s, by one factor for all times."""
    shares, times = power_law(exponent(loss))
    t = np.geomspace(1e-4, 1e2, 400)
    share = (1.0 + shares @ np.expm1(-t / times[:, None])) * t ** exponent(loss)
    assert share.max() / share.min() < 1.028
    assert 0.0 < shares.sum() < 1.0


@pytest.mark.parametrize("loss", LOSSES)
def test_the_exponent_is_that_of_the_loss(loss):
    """The closed form of a strip, integrated independently; 4 ln 2 beta if small."""
    beta = exponent(loss)
    assert lost_share(beta) == pytest.approx(loss, rel=1e-12)

    def stress(t):
        return t ** (1.0 - beta) - 2.0 * np.maximum(t - 1.0, 0.0) ** (1.0 - beta)

    k = 2.0 ** (1.0 / (1.0 - beta))
    end = k / (k - 1.0)
    assert stress(end) == pytest.approx(0.0, abs=1e-12)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    u = 0.5 * (1.0 + nodes)  # t - start = u^4, for the root at the start
    up = 0.5 * weights @ (stress(u**4) * 4.0 * u**3)
    down = 0.5 * weights @ (stress(1.0 + (end - 1.0) * u**4) * 4.0 * u**3) * (end - 1.0)
    assert 1.0 - down / up == pytest.approx(loss, rel=1e-6)
    assert exponent(1e-3) == pytest.approx(1e-3 / (4.0 * np.log(2.0)), rel=1e-3)


def measured_loss(material, duration, strain=0.1, steps=400):
    """Share of the work that a strip loses until its stress is zero, by its law."""
    law, memory = law_in_stretch(material, 1.0), None
    memory = virgin(law)
    path = follow(law, np.linspace(0.0, strain, steps + 1)[1:], duration / steps, memory)
    work, back, before, e = path.work[-1], 0.0, path.stress[-1], strain
    while True:
        e -= strain / steps
        prepare(law, memory, duration / steps)
        stress = law.respond(e, memory, 0)[1]
        if stress < 0.0:
            part = before / (before - stress)
            return 1.0 - (back + 0.5 * before * part * strain / steps) / work
        law.commit(e, memory, 0)
        back += 0.5 * (before + stress) * strain / steps
        before = stress


@pytest.mark.parametrize("loss", LOSSES)
def test_a_strip_loses_its_share_at_any_pace(loss):
    material = STRIP.model_copy(update={"loss": loss})
    found = [measured_loss(material, duration) for duration in (1e-3, 0.1, 10.0, 100.0)]
    np.testing.assert_allclose(found, loss, rtol=0.02)


@pytest.mark.parametrize("reference", [1e-3, 1.0, 60.0])
@pytest.mark.parametrize(
    "memory", [{"loss": 0.4}, {"relaxation_times": (0.02, 3.0), "relaxation_shares": (0.4, 0.3)}]
)
def test_the_curve_holds_at_the_reference_time(memory, reference):
    """After a sudden strain; the modulus, too, in stretching, in bending and of a hinge."""
    material = material_with(**memory, reference_time=reference)
    laws = law_in_stretch(material, 1.3), law_of_section(material, 1.3, 0.0).curve
    for law in laws:
        stress = follow(law, [0.08, 0.08], [0.0, reference]).stress[-1]
        record = stress_law(material)
        k = np.searchsorted(record.knots, 0.08, side="right") - 1
        curve = np.polyval(record.coefficients[k, ::-1], 0.08 - record.knots[k])
        assert stress == pytest.approx(1.3 * curve, rel=1e-12)
        assert law.modulus == pytest.approx(1.3 * material.modulus)
    hinge = follow(law_of_hinge(material), [0.3, 0.3], [0.0, reference])
    assert hinge.stress[-1] == pytest.approx(0.3, rel=1e-12)


def test_branches_are_those_given_or_none():
    branches = {"relaxation_times": (1e-3, 2.0), "relaxation_shares": (0.1, 0.2)}
    given = material_with(**branches, reference_time=1.0)
    shares, times, instant = relaxation_of(given)
    assert (list(shares), list(times)) == ([0.1, 0.2], [1e-3, 2.0])
    left = 1.0 - 0.1 * -np.expm1(-1e3) - 0.2 * -np.expm1(-0.5)
    assert instant == pytest.approx(1.0 / left, rel=1e-12)
    assert relaxation_of(material_with()) is ELASTIC


@pytest.mark.parametrize("z", [1e-12, 1e-9, 1e-4, 9.9e-3, 1.01e-2, 0.3, 30.0])
def test_weights_of_the_dissipation_are_its_integrals(z):
    """Integral of (x exp(-z u) + s (1 - exp(-z u)) / z)^2 z over u = 0 .. 1, in x^2, x s, s^2."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    u, weights = 0.5 * (1.0 + nodes), 0.5 * weights
    decay, grown = np.exp(-z * u), -np.expm1(-z * u) / z
    expected = z * np.array(
        [weights @ decay**2, 2.0 * weights @ (decay * grown), weights @ grown**2]
    )
    found = _square(z, np.exp(-z), -np.expm1(-z) / z)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_a_strip_bends_as_it_is_stretched():
    """Small turns of a straight fibre pair relax as a hinge does."""
    section = law_of_section(STRIP, 1.0, 0.0)
    hinge = law_of_hinge(STRIP)
    one = follow(section.curve, np.linspace(0.0, 1e-3, 9)[1:], 0.2).stress
    two = follow(hinge, np.linspace(0.0, 1e-3, 9)[1:], 0.2).stress
    np.testing.assert_allclose(one, STRIP.modulus * two, rtol=1e-10)
    assert relaxing(section.curve.relaxing.elastic.curve).state_size() == 0
