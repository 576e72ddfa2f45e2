"""Sheets that relax: derivatives, the law of a strip, energies, limits, turned axes."""

import numpy as np
import pytest

from kernels.laws import relaxing_sheet
from kernels.laws.relaxing_sheet import LINE, RelaxingSheet, inverse
from kernels.laws.sheet import neo_hookean
from tests.support.designs.scenes import slopes
from tests.support.kernels.sheets import MODULUS, elastic_only, measured, sheet_of_rubber, strain
from tests.support.kernels.terms import law_errors
from tests.support.materials.memory import prepare, virgin

SHARES, TIMES = (0.3, 0.2, 0.25), (0.01, 0.5, 40.0)
SHEETS = {
    "linear": neo_hookean(MODULUS),
    "rubber": sheet_of_rubber(),
    "ninjaflex": measured("ninjaflex"),
}
HISTORY = [((1.2, 0.9), 0.3), ((0.8, 1.1), 0.9), ((1.1, 1.05), -0.5)]
NAMES = pytest.mark.parametrize("name", SHEETS)


def law_of(name, shares=SHARES, times=TIMES):
    elastic = SHEETS[name]
    return RelaxingSheet(elastic, np.array(shares), np.array(times), elastic.shear_modulus)


def follow(law, path, durations, memory=None):
    """Slopes in c, stored energy, and dissipation so far, after each strain of a path (n, 3)."""
    memory, rows, lost = virgin(law, line=LINE) if memory is None else memory, [], 0.0
    for at, duration in zip(path, np.broadcast_to(durations, len(path)), strict=True):
        prepare(law, memory, duration)
        s = law.respond(*at, memory, 0)[1]
        stored, dissipated = law.commit(*at, memory, 0)
        lost += dissipated
        rows.append((*s, stored, lost))
    return np.array(rows)


def remembered(law, duration):
    memory = virgin(law, line=LINE)
    follow(law, [strain(*at) for at in HISTORY], 0.3, memory)
    prepare(law, memory, duration)
    return memory


@pytest.mark.parametrize("duration", [0.0, 0.01, 1e9])
@NAMES
@pytest.mark.parametrize("at", [*HISTORY, ((1.0, 1.0), 0.0), ((0.6, 1.4), 1.1)])
def test_slopes_and_tangent_are_derivatives(name, at, duration):
    law, c = law_of(name), strain(*at)
    memory = remembered(law, duration)
    size = 3.0 * law.shear_modulus + np.abs(law.respond(*c, memory, 0)[2]).max()
    in_slopes, in_tangent = law_errors(lambda *c: law.respond(*c, memory, 0), c, 2e-6)
    assert in_slopes < 1e-8 * size
    assert in_tangent < 3e-5 * size


@NAMES
@pytest.mark.parametrize("at", [((1.0, 1.0), 0.0), *HISTORY, ((0.3, 2.0), 0.4), ((4.0, 3.0), 1.0)])
def test_inverse_finds_the_strain_of_a_stress(name, at):
    """It also finds the complementary energy of the sheet."""
    law = law_of(name)
    energy, s, expected = relaxing_sheet._response(law, *strain(*at))
    product = s[0] * expected[0] + s[1] * expected[1] + 2.0 * s[2] * expected[2]
    for guess in ((0.0, 0.0, 0.0), (0.3, -0.2, 0.1)):
        found, complement = inverse(law.elastic, s, guess)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8)
        assert complement == pytest.approx(product - energy, rel=1e-7, abs=1e-9 * MODULUS)


@NAMES
def test_the_stress_is_that_by_the_logarithmic_strain(name):
    """Work of s on the change of L equals work of dW/dc on the change of c, turned axes
    included.
    """
    law, at, move = law_of(name), strain(*HISTORY[0]), 1e-6 * np.array([0.4, -0.9, 0.7])
    g = law.elastic.respond(*at)[1]
    _, s, before = relaxing_sheet._response(law, *(at - move))
    _, s, after = relaxing_sheet._response(law, *(at + move))
    _, s, _ = relaxing_sheet._response(law, *at)
    change = np.subtract(after, before) * (1.0, 1.0, 2.0)
    assert s @ change == pytest.approx(2.0 * np.dot(g, move), rel=1e-6)


@pytest.mark.parametrize("time", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("steps", [1, 7])
def test_a_held_strain_relaxes_as_the_closed_form(time, steps):
    """Exactly, at any strain and for any step: s (1 - g + g exp(-t / tau))."""
    at = strain((1.4, 0.8), 0.3)
    law = law_of("linear", (0.6,), (time,))
    whole = np.array(law.elastic.respond(*at)[1])
    for held in (0.0, 1e-2 * time, time, 1e3 * time):
        path = follow(law, [at] * (1 + steps), [0.0, *[held / steps] * steps])
        decay = 0.4 + 0.6 * np.exp(-held / time)
        np.testing.assert_allclose(path[-1, :3], decay * whole, rtol=0, atol=1e-11 * MODULUS)


@NAMES
def test_work_is_stored_or_dissipated(name):
    """The book closes to second order in the step, along a path that stretches, shears and turns
    back.
    """
    law, gaps = law_of(name), []
    for steps in (100, 200, 400):
        t = np.linspace(0.0, 1.0, steps + 1)[1:]
        way = [strain((1 + 0.4 * np.sin(4 * k), 1 - 0.25 * np.sin(6 * k)), k) for k in t]
        path = follow(law, way, 4.0 / steps)
        moves = np.diff(way, axis=0, prepend=np.zeros((1, 3)))
        mean = 0.5 * (path[:, :3] + np.vstack([np.zeros(3), path[:-1, :3]]))
        work = np.cumsum(np.sum(mean * moves, axis=1))
        gaps.append(np.abs(work - path[:, 3] - path[:, 4]).max() / work.max())
    assert gaps[-1] < 5e-4
    assert min(slopes(gaps)) > 1.6


@pytest.mark.parametrize("seed", range(2))
@NAMES
def test_dissipation_never_falls(name, seed):
    """Random steps of random length, with random branches."""
    rng = np.random.default_rng(seed)
    law = law_of(name, 0.98 * rng.dirichlet(np.ones(6))[:5], 10.0 ** rng.uniform(-6, 4, 5))
    way = [strain(rng.uniform(0.6, 1.6, 2), rng.uniform(-2, 2)) for _ in range(60)]
    path = follow(law, way, 10.0 ** rng.uniform(-7, 5, 60))
    assert np.diff(path[:, 4], prepend=0.0).min() >= -1e-9 * path[-1, 4]
    assert path[:, 3].min() > 0.0


def test_stored_energy_is_the_potential_in_no_time():
    law = law_of("ninjaflex")
    memory = remembered(law, 0.0)
    for at in (HISTORY[-1], ((0.8, 0.9), 0.2), ((1.4, 1.1), 1.0)):
        potential = law.respond(*strain(*at), memory, 0)[0]
        again = memory._replace(committed=memory.committed.copy())
        stored, lost = law.commit(*strain(*at), again, 0)
        assert potential == pytest.approx(stored, rel=1e-7)
        assert lost == pytest.approx(0.0, abs=1e-9 * stored)


def test_limits_are_the_instantaneous_and_the_relaxed_sheet():
    law, at = law_of("ninjaflex"), strain(*HISTORY[0])
    energy, s, _ = law.elastic.respond(*at)
    sudden, slow = follow(law, [at], 1e-12), follow(law, [at, at], [0.0, 1e9])
    left = 1.0 - sum(SHARES)
    np.testing.assert_allclose(sudden[-1, :4], [*s, energy], rtol=1e-8)
    np.testing.assert_allclose(slow[-1, :4], [left * k for k in (*s, energy)], rtol=1e-6)


def test_only_a_commit_changes_what_is_remembered():
    law = law_of("ninjaflex")
    memory = remembered(law, 0.2)
    before = memory.committed.copy()
    once = [law.respond(*strain(*at), memory, 0) for at in (*HISTORY, HISTORY[0])]
    assert once[0] == once[-1]
    np.testing.assert_array_equal(memory.committed, before)
    law.commit(*strain((1.3, 0.7), 0.1), memory, 0)
    assert (memory.committed != before).all()


@NAMES
def test_without_branches_it_is_the_elastic_sheet(name):
    law = elastic_only(SHEETS[name])
    assert law.state_size() == 0
    assert law_of(name).state_size() == relaxing_sheet.BRANCHES + 18
    at = strain(*HISTORY[0])
    assert law.respond(*at, virgin(law, 0, LINE), 0) == SHEETS[name].respond(*at)


def test_no_area_is_an_infinite_potential():
    law = law_of("ninjaflex")
    assert law.respond(-1.2, 0.1, 0.0, remembered(law, 0.1), 0)[0] == np.inf
