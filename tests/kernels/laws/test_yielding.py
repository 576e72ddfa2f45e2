"""The yielding law: derivatives, return mapping, cycles of closed form, commits."""

import numpy as np
import pytest

from kernels.laws.elastic import GUARD, guard
from kernels.laws.law import Memory
from kernels.laws.yielding import PATH, PLASTIC, STATE, Yielding
from tests.support.kernels.terms import law_errors

MODULUS, LIMIT, HARDENING = 2e9, 40e6, 150e6
YIELD = LIMIT / MODULUS
LAWS = {
    "perfect": Yielding(MODULUS, LIMIT, 0.0, MODULUS),
    "hardening": Yielding(MODULUS, LIMIT, HARDENING, MODULUS),
}


@pytest.fixture(params=LAWS)
def law(request):
    return LAWS[request.param]


def memory_of(plastic=0.0, path=0.0):
    """Memory of one point with a plastic strain and the sum of its changes."""
    return Memory(np.array([[plastic, path]]), np.empty((1, 2)), None)


def pulled(law, strains, memory):
    """Stress after each of ``strains`` (k,), and the dissipation of all; each is committed."""
    stresses, dissipated = [], 0.0
    for strain in strains:
        potential, stress, _ = law.respond(strain, memory, 0)
        released, lost = law.commit(strain, memory, 0)
        held = 0.5 * law.modulus * (strain - memory.committed[0, PLASTIC]) ** 2
        held += guard(law.guarded, strain)[0]
        assert potential == pytest.approx(held + released, rel=1e-12)
        assert released == lost
        dissipated += lost
        stresses.append(stress)
    return np.array(stresses), dissipated


@pytest.mark.parametrize(
    "state", [(0.0, 0.0), (0.03, 0.03), (-0.015, 0.05)], ids=["new", "pulled", "reversed"]
)
@pytest.mark.parametrize("strain", [0.0, 0.7 * YIELD, 3 * YIELD, -3 * YIELD, 0.2, -0.72, -0.85])
def test_derivatives_match_differences(law, state, strain):
    memory = memory_of(*state)
    value, stress, tangent = law.respond(strain, memory, 0)
    errors = law_errors(lambda e: law.respond(e, memory, 0), strain, 1e-3 * YIELD)
    stiff = MODULUS + abs(tangent)
    assert errors[0] < 1e-8 * (abs(stress) + stiff * YIELD)
    assert errors[1] < 1e-6 * stiff
    assert value >= 0.0


@pytest.mark.parametrize("at", [YIELD, -YIELD, GUARD])
def test_potential_and_stress_are_continuous_at_yield_and_guard(law, at):
    near = [law.respond(at + side * 1e-13, memory_of(), 0) for side in (-1, 1)]
    assert near[0][0] == pytest.approx(near[1][0], rel=1e-9)
    assert near[0][1] == pytest.approx(near[1][1], rel=1e-9)
    assert (abs(near[0][2] - near[1][2]) < 1e-6 * MODULUS) == (at == GUARD)


def test_the_potential_is_the_least_over_the_flow(law):
    """Elastic energy plus plastic work is least at the flow that was found; other flows around it
    are tried.
    """
    memory, strain = memory_of(0.01, 0.02), 0.06
    value = law.respond(strain, memory, 0)[0]
    d = np.linspace(0.0, 0.05, 100_001)
    elastic, limit = strain - 0.01 - d, law.limit + law.hardening * 0.02
    tried = 0.5 * law.modulus * elastic**2 + d * (limit + 0.5 * law.hardening * d)
    assert value <= tried.min() * (1.0 + 1e-12)
    assert value == pytest.approx(tried.min(), rel=1e-6)


def test_the_return_map_follows_a_fine_explicit_integration(law):
    """The rate law is integrated along a path that turns three times; plastic work is lost."""
    turns = np.array([0.0, 0.05, -0.03, 0.08, 0.02])
    memory, stress, grown, work = memory_of(), 0.0, 0.0, 0.0
    stresses, lost = pulled(law, turns, memory)
    share = law.modulus / (law.modulus + law.hardening)
    for k in range(1, len(turns)):
        steps = 50_000
        change = (turns[k] - turns[k - 1]) / steps
        for _ in range(steps):
            flows = stress * change > 0.0 and abs(stress) >= law.limit + law.hardening * grown
            stress += law.modulus * change * (1.0 - share if flows else 1.0)
            grown += abs(change) * share if flows else 0.0
            work += abs(stress * change) * share if flows else 0.0
        assert stresses[k] == pytest.approx(stress, rel=1e-4)
    assert memory.committed[0, PATH] == pytest.approx(grown, rel=1e-4)
    assert lost == pytest.approx(work, rel=1e-4)


def test_a_cycle_without_hardening_loses_the_area_of_its_loop():
    memory, top = memory_of(), 0.06
    pulled(LAWS["perfect"], [top], memory)
    _, lost = pulled(LAWS["perfect"], [-top, top], memory)
    assert lost == pytest.approx(2.0 * LIMIT * (2.0 * top - 2.0 * YIELD), rel=1e-12)


def test_only_a_commit_changes_the_state(law):
    memory = memory_of(0.01, 0.03)
    for strain in (0.3, -0.3):
        law.respond(strain, memory, 0)
    assert memory.committed.tolist() == [[0.01, 0.03]]
    kept = memory.committed.copy()
    once = law.commit(0.1, memory, 0)
    memory.committed[:] = kept
    assert law.commit(0.1, memory, 0) == once
    assert law.commit(0.1, memory, 0) == pytest.approx((0.0, 0.0), abs=1e-6)
    assert memory.committed.shape == (1, STATE)
