"""Laws that relax: derivatives, closed forms over decades of time, energies, limits."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from kernels.laws import relaxation
from kernels.laws.elastic import GUARD
from kernels.laws.relaxation import NEAR, inverse
from kernels.laws.softening import Softening
from sweep.scene.material import as_law, linear_law
from tests.support.designs.scenes import slopes
from tests.support.kernels.frames import MODULUS
from tests.support.kernels.terms import law_errors
from tests.support.materials.memory import (
    follow,
    measured,
    prepare,
    relaxing,
    there_and_back,
    virgin,
)

SHARES, TIMES = (0.3, 0.2, 0.25), (0.01, 0.5, 40.0)
STRAIN = 0.12
HISTORY = (0.05, -0.03, 0.08)


def straight():
    return as_law(linear_law(MODULUS), 1.0, MODULUS)


def solid(curve, share=0.6, time=0.5):
    """A spring beside one branch."""
    return relaxing(curve, [share], [time])


def remembered(law, duration):
    """The memory of a point with a past, prepared for a step."""
    memory = virgin(law)
    follow(law, HISTORY, 0.3, memory)
    prepare(law, memory, duration)
    return memory


@pytest.mark.parametrize("duration", [0.0, 0.01, 1e9])
@pytest.mark.parametrize(
    ("strain", "step", "within"),
    [
        *((e, 1e-5, 1e-6) for e in (1e-4, HISTORY[-1], -0.22, 0.35, 0.9, GUARD - 0.1)),
        *((knot, 1e-6, 1e-4) for knot in (0.0, 0.05, GUARD)),  # the slope of the tangent jumps
    ],
)
def test_stress_and_tangent_are_derivatives(strain, step, within, duration):
    law = relaxing(measured(), SHARES, TIMES)
    memory = remembered(law, duration)
    errors = law_errors(lambda e: law.respond(e, memory, 0), strain, step)
    assert max(errors) < within * law.modulus


@pytest.mark.parametrize("time", [1e-6, 1e-3, 1.0, 1e3])
@pytest.mark.parametrize("steps", [1, 7])
def test_a_held_strain_relaxes_as_the_closed_form(time, steps):
    """Exactly, for any step: Y e (1 - g + g exp(-t / tau)); nothing is done from outside."""
    for held in (0.0, 1e-2 * time, time, 1e3 * time):
        law = solid(straight(), time=time)
        path = follow(law, np.full(1 + steps, STRAIN), [0.0, *np.full(steps, held / steps)])
        decay = 0.4 + 0.6 * np.exp(-held / time)
        assert path.stress[-1] == pytest.approx(MODULUS * STRAIN * decay, rel=1e-12)
        lost = 0.5 * 0.6 * MODULUS * STRAIN**2 * (1.0 - np.exp(-2.0 * held / time))
        assert path.dissipated[-1] == pytest.approx(lost, rel=1e-11, abs=1e-15)


def ramp(t, time, rate=1.0):
    """Stress of a spring and a branch of 0.4 and 0.6 Y in a ramp of strain, after ``t``."""
    return MODULUS * rate * (0.4 * t + 0.6 * time * -np.expm1(-t / time))


@pytest.mark.parametrize("period", [1e-3, 0.1, 1.0, 1e3])
@pytest.mark.parametrize("steps", [1, 20])
def test_a_cycle_of_even_ramps_is_exact(period, steps):
    """Six decades of dt over the time of the branch; work by quadrature of the closed form."""
    time, rate = 0.5, STRAIN / period

    def stress(t):
        return ramp(t, time, rate) - (2.0 * ramp(t - period, time, rate) if t > period else 0.0)

    law = solid(straight(), time=time)
    path = follow(law, there_and_back(STRAIN, steps), period / steps)
    times = period / steps * np.arange(1, 2 * steps + 1)
    np.testing.assert_allclose(path.stress, [stress(t) for t in times], atol=1e-12 * MODULUS)
    up, down = (quad(stress, a, b, epsabs=0.0, epsrel=1e-12)[0] for a, b in
                ((0.0, period), (period, 2.0 * period)))  # fmt: skip
    assert path.stored[-1] + path.dissipated[-1] == pytest.approx(rate * (up - down), rel=1e-9)


def test_a_sinusoidal_strain_is_of_second_order():
    """The final stress follows from the complex modulus."""
    time, omega = 0.5, 3.0
    complex_modulus = MODULUS * (0.4 + 0.6 * 1j * omega * time / (1.0 + 1j * omega * time))
    off = []
    for steps in (32, 64, 128):
        t = np.arange(1, 10 * steps + 1) * 2.0 * np.pi / (omega * steps)
        path = follow(solid(straight(), time=time), STRAIN * np.sin(omega * t), t[0])
        steady = np.imag(complex_modulus * STRAIN * np.exp(1j * omega * t))
        off.append(np.abs(path.stress - steady)[-steps:].max() / MODULUS)
        assert path.gap < 10.0 / steps**2
    np.testing.assert_allclose(slopes(off), 2.0, atol=0.05)


@pytest.mark.parametrize("name", ["ninjaflex", "filaflex_60a"])
@pytest.mark.parametrize("strain", [0.3, -0.3])
def test_work_is_stored_or_dissipated(name, strain):
    """The book closes to second order for a curve."""
    law = relaxing(measured(name), SHARES, TIMES)
    gaps = [
        follow(law, there_and_back(strain, steps), 4.0 / steps).gap for steps in (200, 400, 800)
    ]
    assert gaps[-1] < 2e-4
    assert min(slopes(gaps)) > 1.6


@pytest.mark.parametrize("seed", range(3))
def test_dissipation_never_falls(seed):
    """Random steps of random length, with random branches."""
    rng = np.random.default_rng(seed)
    shares = 0.98 * rng.dirichlet(np.ones(6))[:5]
    law = relaxing(measured(), shares, 10.0 ** rng.uniform(-6, 4, 5))
    path = follow(law, rng.uniform(-0.5, 1.0, 60), 10.0 ** rng.uniform(-7, 5, 60))
    assert np.diff(path.dissipated, prepend=0.0).min() >= -1e-12 * path.dissipated[-1]
    assert path.stored.min() > 0.0


def test_stored_energy_is_the_potential_in_no_time():
    law = relaxing(measured(), SHARES, TIMES)
    memory = remembered(law, 0.0)
    for strain in (HISTORY[-1], -0.2, 0.4):
        potential, stress, _ = law.respond(strain, memory, 0)
        again = memory._replace(committed=memory.committed.copy())
        released, lost = law.commit(strain, again, 0)
        assert released == pytest.approx(0.0, abs=1e-7 * potential)
        assert lost == pytest.approx(0.0, abs=1e-15)
        assert law.respond(strain, memory, 0)[1] == stress


def test_stored_energy_is_a_function_of_state():
    """It depends on the strain and on the viscous strain of each branch, whatever the path."""
    law = solid(measured(), 0.6, 0.5)
    one, two = virgin(law), virgin(law)
    follow(law, [0.2, 0.1], [0.0, 0.3], one)
    follow(law, [0.4, -0.1, 0.1], [0.0, 0.01, 0.02], two)
    state = one.committed[0]
    two.committed[0, relaxation.BRANCHES :] = state[relaxation.BRANCHES :]
    prepare(law, two, 0.0)
    assert law.commit(0.1, two, 0)[1] == 0.0
    assert two.committed[0, relaxation.STORED] == pytest.approx(state[relaxation.STORED], rel=1e-9)


def test_only_a_commit_changes_what_is_remembered():
    law = relaxing(measured(), SHARES, TIMES)
    memory = remembered(law, 0.2)
    before = memory.committed.copy()
    once = [law.respond(strain, memory, 0) for strain in (0.3, -0.2, 0.3)]
    assert once[0] == once[2]
    np.testing.assert_array_equal(memory.committed, before)
    law.commit(0.3, memory, 0)
    changed = memory.committed[0] != before[0]
    assert np.delete(changed, relaxation.MOST).all()
    assert not changed[relaxation.MOST]  # of a law that softens


@pytest.mark.parametrize("strain", [-0.9, -0.4, -1e-3, 0.02, 0.5, 3.0, 7.0])
def test_inverse_finds_the_strain_of_a_stress(strain):
    curve = measured()
    stress = curve.respond(strain)[1]
    exact = brentq(lambda e: curve.respond(e)[1] - stress, -0.999, 9.0, xtol=1e-14)
    for guess in (0.0, -0.3, 2.0):
        found, complement = inverse(Softening(curve, 0.0, 0.0, 0.0), 0.0, stress, guess)
        assert found == pytest.approx(exact, abs=10.0 * NEAR**2)
        assert complement == pytest.approx(stress * exact - curve.respond(exact)[0], rel=1e-7)


def test_straight_pieces_do_not_show():
    """`NEAR` changes energies by less than 1e-7: stored ones are integrals of the curve."""
    law, curve = relaxing(measured(), SHARES, TIMES), measured()
    memory, strains = virgin(law), there_and_back(0.2, 50)
    path, at = follow(law, strains, 0.05, memory), strains[-1]
    stored = (1.0 - sum(SHARES)) * curve.respond(at)[0]
    for share, s in zip(SHARES, memory.committed[0, relaxation.BRANCHES :], strict=False):
        start = brentq(lambda e, s=s: curve.respond(e)[1] - s, -0.9, 2.0, xtol=1e-15)
        stored += share * quad(lambda e, s=s: curve.respond(e)[1] - s, start, at, epsrel=1e-12)[0]
    assert path.stored[-1] == pytest.approx(stored, rel=1e-6)
