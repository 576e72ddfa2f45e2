"""Laws that soften on reloading: derivatives, the loss of a cycle, the energy of a second one."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from kernels.laws.relaxation import MOST
from kernels.laws.softening import Softening
from tests.support.designs.scenes import slopes
from tests.support.kernels.terms import law_errors
from tests.support.materials.memory import follow, measured, relaxing, there_and_back, virgin

R, M, BETA = 2.0, 0.2, 0.1  # m in MPa
SOFTENING = (1.0 / R, M, BETA)
DEEP = 0.3


LAW = Softening(measured(), *SOFTENING)
GREATEST = measured().respond(DEEP)[0]


@pytest.mark.parametrize("strain", [1e-6, 0.05, -0.1, 0.299, 0.301, 0.5])
def test_stress_and_tangent_are_derivatives(strain):
    in_stress, in_tangent = law_errors(lambda e: LAW.respond(e, GREATEST), strain + 1e-5, 1e-6)
    assert in_stress < 1e-8 * measured().modulus
    assert in_tangent < 1e-4 * measured().modulus


@pytest.mark.parametrize("strain", [0.1, 0.25, -0.2])
def test_the_potential_is_the_integral_of_the_softened_stress(strain):
    """Eta by its formula."""

    def stress(e):
        energy, pulled, _ = measured().respond(e)
        return pulled * (1.0 - math.erf((GREATEST - energy) / (M + BETA * GREATEST)) / R)

    energy, found, _ = LAW.respond(strain, GREATEST)
    assert found == pytest.approx(stress(strain), rel=1e-12)
    assert energy == pytest.approx(quad(stress, 0.0, strain, epsrel=1e-11)[0], rel=1e-8)


def test_the_first_loading_is_that_of_the_curve_and_the_potential_has_no_jump():
    first = [measured().respond(e)[1:] for e in (0.1, 0.4)]
    assert LAW.respond(0.1, 0.0)[1:] == first[0]
    assert LAW.respond(0.4, GREATEST)[1:] == first[1]
    below, above = (LAW.respond(DEEP + side, GREATEST)[0] for side in (-1e-9, 1e-9))
    assert above == pytest.approx(below, rel=1e-7)


def test_a_cycle_loses_the_area_of_its_loop_and_a_second_one_nothing():
    """Stored energy falls as the greatest energy grows; the loop is closed after that."""
    law = relaxing(measured(), softening=SOFTENING)
    memory = virgin(law)
    first = follow(law, there_and_back(DEEP, 400), 1.0, memory)
    again = follow(law, there_and_back(DEEP, 400), 1.0, memory)
    assert first.work[-1] == pytest.approx(first.dissipated[-1], rel=1e-4)
    assert first.stored[-1] == pytest.approx(0.0, abs=1e-9)
    assert again.dissipated[-1] == pytest.approx(0.0, abs=1e-12)
    assert again.work[399] == pytest.approx(first.work[399] - first.dissipated[-1], rel=1e-4)
    assert memory.committed[0, MOST] == pytest.approx(GREATEST, rel=1e-12)


@pytest.mark.parametrize("strain", [DEEP, -DEEP])
def test_work_is_stored_or_dissipated(strain):
    """The book closes to second order without branches, to first order with them, as their curve
    has a kink.
    """
    for law, order in (
        (relaxing(measured(), softening=SOFTENING), 1.9),
        (relaxing(measured(), [0.5], [2.0], SOFTENING), 0.8),
    ):
        gaps = [
            follow(law, np.tile(there_and_back(strain, n), 2), 4.0 / n).gap for n in (50, 100, 200)
        ]
        assert gaps[-1] < 1e-3
        assert min(slopes(gaps)) > order


@pytest.mark.parametrize("seed", range(2))
def test_dissipation_never_falls(seed):
    rng = np.random.default_rng(seed)
    law = relaxing(measured(), [0.3, 0.3], [0.1, 10.0], SOFTENING)
    path = follow(law, rng.uniform(-0.4, 0.8, 60), 10.0 ** rng.uniform(-4, 3, 60))
    assert np.diff(path.dissipated, prepend=0.0).min() >= -1e-6 * path.dissipated[-1]
