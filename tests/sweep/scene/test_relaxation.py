"""The branches of a material: a power law and its loss, the reference time, given branches."""

import numpy as np
import pytest

from kernels.terms.relaxation import _square
from sweep.config.case import Material
from sweep.scene.material import law_in_stretch
from sweep.scene.relaxation import ELASTIC, exponent, lost_share, power_law, relaxation_of
from tests.support.memory import follow, there_and_back

LINEAR = {"modulus": 12e6, "density": 1190.0, "plane": "stress"}
LOSSES = (0.1, 0.2, 0.3, 0.45)


@pytest.mark.parametrize("loss", LOSSES)
def test_branches_follow_a_power_of_time(loss):
    """From a tenth of a millisecond to a hundred seconds."""
    beta = exponent(loss)
    shares, times = power_law(beta)
    t = np.geomspace(1e-4, 1e2, 61)
    modulus = 1.0 - shares.sum() + np.exp(-t[:, None] / times) @ shares
    scale = modulus * t**beta
    assert scale.max() / scale.min() < 1.014
    assert shares.sum() < 1.0


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("time", [1e-3, 0.1, 10.0, 100.0])
def test_a_strip_loses_what_is_asked_for_at_any_rate(loss, time):
    """Stretched and released evenly until its stress is zero."""
    law = law_in_stretch(Material(**LINEAR, loss=loss), 1.0)
    path = follow(law, there_and_back(0.01, 400), time / 400)
    loading = path.work[399]
    returned = loading - path.work[path.stress > 0.0][-1]
    assert 1.0 - returned / loading == pytest.approx(loss, rel=0.02)


def test_loss_grows_with_the_exponent_as_it_is_quoted():
    """Near 2.4 beta; a cycle to zero strain loses 4 - 2^(2 - beta)."""
    assert lost_share(0.0) == 0.0
    assert lost_share(0.1) == pytest.approx(0.25, abs=0.002)
    assert [round(lost_share(beta), 2) for beta in (0.1, 0.15, 0.2)] == [0.25, 0.36, 0.45]
    assert exponent(lost_share(0.17)) == pytest.approx(0.17, rel=1e-9)


@pytest.mark.parametrize("strain", [0.02, 0.3, -0.2])
@pytest.mark.parametrize("time", [0.01, 1.0, 50.0])
def test_the_curve_holds_at_the_reference_time(strain, time):
    elastic = law_in_stretch(Material(), 1.0).relaxing.elastic.curve.respond(strain)[1]
    for memory in (
        {"loss": 0.4},
        {"relaxation_times": (1e-3, 2.0), "relaxation_shares": (0.3, 0.5)},
    ):
        law = law_in_stretch(Material(**memory, reference_time=time), 1.0)
        path = follow(law, [strain, strain], [0.0, time])
        assert path.stress[-1] == pytest.approx(elastic, rel=1e-9)


def test_branches_are_taken_as_given():
    given = {"relaxation_times": (1e-3, 2.0), "relaxation_shares": (0.3, 0.5)}
    shares, times, instant = relaxation_of(Material(**given, reference_time=1e9))
    np.testing.assert_array_equal((shares, times), ((0.3, 0.5), (1e-3, 2.0)))
    assert instant == pytest.approx(5.0)
    assert relaxation_of(Material()) is ELASTIC


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
