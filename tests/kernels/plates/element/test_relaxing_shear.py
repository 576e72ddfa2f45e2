"""Transverse shear that relaxes: the standard solid, its energies, a wall that is stretched."""

import numpy as np
import pytest

from kernels.laws.relaxing_sheet import RelaxingSheet
from kernels.laws.sheet import neo_hookean
from kernels.plates.element import relaxing_shear, shear
from kernels.plates.element.relaxing_shear import LINE
from tests.support.designs.scenes import slopes
from tests.support.materials.memory import virgin

SHARES, TIMES = np.array([0.35, 0.25]), np.array([0.5, 20.0])
LAW = RelaxingSheet(neo_hookean(12.0), SHARES, TIMES, 4.0)
STIFFNESS = (3.0, 2.0)
FLAT, STRAINED = (1.0, 1.0, 0.0), (1.2, 0.8, 0.1)
REST = np.array([0.02, -0.01, 0.0, 0.03])
SHEARED = np.array([0.3, -0.2, 0.1, 0.25])


def step(memory, g, duration, surface=FLAT):
    """Potential and forces at the shears ``g`` (4,), then stored energy and dissipation."""
    LAW.set_pace(duration, memory.pace)
    relaxing_shear.begin(LAW, memory, 0, REST, surface, STIFFNESS)
    rest, soft, constant = relaxing_shear.of_step(memory, 0, STIFFNESS)
    energy, force = shear._energy(tuple(g + REST - rest), surface, soft)
    stored, lost = relaxing_shear.commit(LAW, tuple(g), memory, 0, surface, STIFFNESS)
    return energy + constant, np.array(force[:4]), stored, lost


def elastic(g, surface=FLAT):
    energy, force = shear._energy(tuple(g), surface, STIFFNESS)
    return energy, np.array(force[:4])


@pytest.mark.parametrize("surface", [FLAT, STRAINED])
@pytest.mark.parametrize("steps", [1, 6])
@pytest.mark.parametrize("held", [0.0, 0.1, 1.0, 1e4])
def test_a_held_shear_relaxes_as_the_closed_form(surface, steps, held):
    memory = virgin(LAW, line=LINE)
    step(memory, SHEARED, 0.0, surface)
    lost = 0.0
    for _ in range(steps):
        _, force, stored, more = step(memory, SHEARED, held / steps, surface)
        lost += more
    energy, whole = elastic(SHEARED, surface)
    left = 1.0 - SHARES.sum() + SHARES @ np.exp(-held / TIMES)
    np.testing.assert_allclose(force, left * whole, rtol=1e-12)
    left = 1.0 - SHARES.sum() + SHARES @ np.exp(-2.0 * held / TIMES)
    assert stored == pytest.approx(left * energy, rel=1e-12)
    assert lost == pytest.approx((1.0 - left) * energy, rel=1e-11, abs=1e-15)


@pytest.mark.parametrize("period", [1e-3, 0.3, 10.0])
def test_work_of_even_ramps_is_stored_or_dissipated(period):
    """The book closes to second order, as the work follows the trapezoidal rule."""
    gaps = []
    for steps in (20, 40, 80):
        memory, work, lost, last = virgin(LAW, line=LINE), 0.0, 0.0, np.zeros(4)
        up = np.linspace(0.0, 1.0, steps + 1)
        ways = [*up[1:], *up[-2::-1]]
        before = np.zeros(4)
        for way in ways:
            _, force, stored, more = step(memory, way * SHEARED, period / steps)
            work += 0.5 * (force + before) @ (way * SHEARED - last)
            lost, before, last = lost + more, force, way * SHEARED
        gaps.append(abs(work - stored - lost) / elastic(SHEARED)[0])
    assert gaps[-1] < 1e-3
    assert gaps[0] < 1e-12 or min(slopes(gaps)) > 1.9


def test_the_potential_without_time_is_the_stored_energy():
    memory = virgin(LAW, line=LINE)
    step(memory, SHEARED, 0.4, STRAINED)
    potential, _, stored, lost = step(memory, 0.5 * SHEARED, 0.0, STRAINED)
    assert potential == pytest.approx(stored, rel=1e-12)
    assert lost == 0.0


def test_a_step_begins_from_the_stored_energy_also_of_a_wall_that_is_stretched():
    memory = virgin(LAW, line=LINE)
    stored = step(memory, SHEARED, 0.4, STRAINED)[2]
    assert step(memory, SHEARED, 1e-12, STRAINED)[0] == pytest.approx(stored, rel=1e-9)


def test_opposite_shears_of_a_branch_count():
    """Sheared to and fro at random: dissipation is positive in every step."""
    memory, rng = virgin(LAW, line=LINE), np.random.default_rng(3)
    for _ in range(50):
        _, _, stored, lost = step(memory, rng.uniform(-1, 1, 4), 10.0 ** rng.uniform(-4, 3))
        assert lost > 0.0
        assert stored > 0.0
