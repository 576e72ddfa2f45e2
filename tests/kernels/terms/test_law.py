"""Laws with memory, through the interface alone: potential, commit, book and march."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from kernels.solve import newton
from kernels.terms import stretch
from kernels.terms.elastic import GUARD
from kernels.terms.law import Memory
from tests.support.frames import curve_law, frame, linear_law, shaken, stretch_of, walls_of
from tests.support.laws import Section, standard_solid
from tests.support.relaxing import BRANCH, STRAIN, TIME, printed
from tests.support.scenes import slopes
from tests.support.terms import differences, room

MODULUS, BEFORE = 12e6, 0.07
BOOK = ("stretch", "bend", "kinetic", "material", "integrator")
DURATIONS = pytest.mark.parametrize("duration", [0.0, 1e-3 * TIME, TIME, 1e3 * TIME, math.inf])


def solid(spring=linear_law, modulus=MODULUS):
    return standard_solid(spring(modulus), BRANCH, TIME)


def remembered(duration, before=BEFORE):
    return Memory(np.array([[before]]), duration)


def fibres(*values):
    """A section of a standard solid through 0.8 mm, whose fibres remember some ``values``."""
    at, share = np.polynomial.legendre.leggauss(len(values))
    section = Section(solid(curve_law), 0.4e-3 * at, 4e-6 * share, MODULUS)
    return section, Memory(np.array([values]), TIME)


def error(law, strain, memory, step=1e-4):
    """Error of stress and tangent against differences of potential and stress, in moduli."""
    at, steps = np.array([strain]), np.array([step])
    _, stress, tangent = law.respond(strain, memory, 0)
    by_energy = differences(lambda e: law.respond(e[0], memory, 0)[0], at, steps)[0]
    by_stress = differences(lambda e: law.respond(e[0], memory, 0)[1], at, steps)[0]
    return max(abs(stress - by_energy), abs(tangent - by_stress)) / law.modulus


@DURATIONS
@pytest.mark.parametrize("strain", [BEFORE, 1e-3, -0.2, 0.35, 0.9])
@pytest.mark.parametrize("modulus", [MODULUS, 12.0])
def test_stress_and_tangent_are_derivatives(strain, duration, modulus):
    """Where the branch is free of stress, and anywhere else."""
    assert error(solid(curve_law, modulus), strain, remembered(duration)) < 1e-9


@DURATIONS
@pytest.mark.parametrize("strain", [0.0, 0.1, GUARD, GUARD - 0.1])
def test_stress_and_tangent_are_derivatives_at_knots_and_at_the_guard(strain, duration):
    """The slope of the tangent jumps at all but the last: differences are of the first order."""
    assert error(solid(curve_law), strain, remembered(duration), 1e-5) < 1e-4


@pytest.mark.parametrize("duration", [1e-3 * TIME, TIME, 1e3 * TIME])
def test_potential_is_the_least_over_what_is_remembered(duration):
    law, strain = solid(), -0.13
    r = duration / TIME

    def potential(q):
        return 0.5 * law.branch * ((strain - q) ** 2 + (q - BEFORE) ** 2 / r)

    least = minimize_scalar(potential, (strain, BEFORE), tol=1e-12)
    stored = 0.5 * MODULUS * strain**2
    memory = remembered(duration)
    assert law.respond(strain, memory, 0)[0] == pytest.approx(stored + least.fun, rel=1e-9)
    after = least.x
    kept, lost = law.commit(strain, memory, 0)
    assert memory.committed[0, 0] == pytest.approx(after, abs=1e-6)
    assert kept == pytest.approx(stored + 0.5 * law.branch * (strain - after) ** 2, rel=1e-5)
    assert lost == pytest.approx(law.branch / r * (after - BEFORE) ** 2, rel=1e-4)


def test_only_a_commit_changes_what_is_remembered():
    law, memory = solid(), remembered(TIME)
    once = [law.respond(strain, memory, 0) for strain in (0.3, -0.2, 0.3)]
    assert once[0] == once[2]
    assert memory.committed[0, 0] == BEFORE
    law.commit(0.3, memory, 0)
    assert memory.committed[0, 0] == pytest.approx(0.5 * (BEFORE + 0.3))


def test_nothing_flows_in_no_time_and_all_in_eternity():
    law, strain, relaxed = solid(), 0.2, 0.5 * MODULUS * 0.2**2
    sudden, memory = remembered(0.0), remembered(math.inf)
    stored = relaxed + 0.5 * law.branch * (strain - BEFORE) ** 2
    assert law.commit(strain, sudden, 0) == pytest.approx((stored, 0.0), rel=1e-12)
    assert sudden.committed[0, 0] == BEFORE
    assert law.commit(strain, memory, 0) == pytest.approx((relaxed, 0.0), rel=1e-12)
    assert memory.committed[0, 0] == pytest.approx(strain)


def gap(steps):
    """Work along a ramp less what is stored and dissipated, J/m^3."""
    law, strains = solid(), np.linspace(0.0, STRAIN, steps + 1)[1:]
    memory, work, lost, before = remembered(2.0 * TIME / steps, 0.0), 0.0, 0.0, 0.0
    for strain in strains:
        stress = law.respond(strain, memory, 0)[1]
        work += 0.5 * (before + stress) * STRAIN / steps
        stored, dissipated = law.commit(strain, memory, 0)
        lost, before = lost + dissipated, stress
    return (work - stored - lost) / work


def test_work_is_stored_or_dissipated():
    found = [gap(steps) for steps in (16, 32, 64)]
    assert abs(found[-1]) < 0.01
    np.testing.assert_allclose(slopes(found), 1.0, atol=0.06)


def test_an_elastic_law_keeps_no_number():
    law, none = linear_law(MODULUS), Memory(np.empty((0, 0)), TIME)
    assert (law.state_size(), solid().state_size()) == (0, 1)
    assert law.commit(0.1, none, 0) == pytest.approx((0.5 * MODULUS * 0.1**2, 0.0))


def test_walls_release_what_the_law_dissipates():
    """E_s falls to what is stored; the rows of memory are those of the elements."""
    of, law = frame([(0, 0), (3, 0), (0.3, 2.2)], [(0, 1), (0, 2)], [2, 1]), solid(modulus=12.0)
    walls, elements = walls_of(of), stretch_of(of)
    memory = Memory(np.array([[0.01], [-0.02], [0.03], [9.0]]), TIME)
    shape, resultants, _ = room(walls)
    x = shaken(of, 1).reshape(-1)
    ends = x[: 2 * len(of.points)].reshape(-1, 2)[of.edges]
    shape.length[:] = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    before = stretch.evaluate(elements, law, memory, shape, resultants, False)
    q, strain = memory.committed[:3, 0].copy(), shape.length / of.l0 - 1.0
    released, lost = stretch.commit(elements, law, memory, shape)
    volume, after = elements.area * of.l0, 0.5 * (strain - q)
    stored = 0.5 * 12.0 * strain**2 + 0.5 * law.branch * after**2
    assert before - released == pytest.approx(volume @ stored, rel=1e-12)
    assert lost == pytest.approx(volume @ (law.branch * after**2), rel=1e-12)
    np.testing.assert_allclose(memory.committed[:, 0], [*(q + after), 9.0], rtol=1e-12)


@pytest.mark.parametrize("strain", [(0.0, 0.0), (0.05, 300.0), (-0.2, -80.0)])
def test_a_coupled_section_has_its_derivatives(strain):
    """Force and moment of axial strain and curvature: a law of two strains, one of its fibres."""
    section, memory = fibres(0.02, -0.05, 0.0, 0.1)
    at, unit = np.array(strain), np.array([1.0, 1e3])
    _, stress, (axial, coupled, bending) = section.respond(strain, memory, 0)
    steps = 1e-5 * unit
    by_energy = differences(lambda e: section.respond((e[0], e[1]), memory, 0)[0], at, steps)
    by_stress = differences(
        lambda e: np.array(section.respond((e[0], e[1]), memory, 0)[1]), at, steps
    )
    scale = axial
    assert np.abs(stress - by_energy) * unit == pytest.approx(0.0, abs=1e-8 * scale)
    tangent = np.array([[axial, coupled], [coupled, bending]])
    assert (np.abs(tangent - by_stress) * np.outer(unit, unit)).max() < 1e-5 * scale


def test_a_coupled_section_commits_its_fibres():
    before = (0.02, -0.05, 0.0, 0.1)
    section, memory = fibres(*before)
    potential = section.respond((0.05, 300.0), memory, 0)[0]
    stored, lost = section.commit((0.05, 300.0), memory, 0)
    strain = 0.05 + 300.0 * section.height
    assert section.state_size() == 4
    assert potential == pytest.approx(stored + 0.5 * lost, rel=1e-12)
    np.testing.assert_allclose(memory.committed[0], 0.5 * (strain + before), rtol=1e-12)


def residual(rows):
    """Largest gap of the book of all rows, as a share of the most work."""
    left = np.array(rows["work"]) - sum(np.array(rows[name]) for name in BOOK)
    return np.abs(left).max() / max(rows["work"])


def test_a_quasi_static_hold_relaxes_as_the_closed_form():
    """Without inertia, by the duration of its steps; of the first order in them."""
    off, counts = [], (8, 16, 32)
    found = printed("held", *((steps,) for steps in counts))
    for steps, (outcomes, rows) in zip(counts, found, strict=True):
        assert outcomes == [newton.CONVERGED] * 2
        force = np.array(rows["reaction_top"])
        decay = (1.0 + 1.0 / steps) ** -np.arange(steps + 1.0)
        elastic = force[0] / (1.0 + BRANCH)
        np.testing.assert_allclose(force, elastic * (1.0 + BRANCH * decay), rtol=1e-9)
        off.append(force[-1] / elastic - 1.0 - BRANCH * math.exp(-1.0))
        assert np.ptp(rows["work"]) < 1e-12 * rows["work"][0]
        assert residual(rows) < 1e-9
    np.testing.assert_allclose(slopes(off), 1.0, atol=0.05)


def test_a_hold_dissipates_what_the_branch_gives_up():
    """The dashpot's share of the closed form; what backward Euler loses is the rest."""
    short, shorter = (rows for _, rows in printed("held", (16,), (32,)))
    given = short["stretch"][0] * BRANCH / (1.0 + BRANCH) * (1.0 - math.exp(-2.0))
    errors = [rows["material"][-1] / given - 1.0 for rows in (short, shorter)]
    assert slopes(errors) == pytest.approx(1.0, abs=0.1)
    assert slopes([rows["integrator"][-1] for rows in (short, shorter)]) == pytest.approx(1.0, 0.1)


@pytest.mark.parametrize("dynamic", [False, True])
def test_a_loop_loses_most_near_the_time_of_the_law(dynamic):
    """A lattice that buckles, down and up again: the book closes, and what is lost is the law's."""
    lost, times = [], (1e-3 * TIME, TIME, 1e3 * TIME)
    for outcomes, rows in printed("cycled", *((time, dynamic, 8) for time in times)):
        assert outcomes == [newton.CONVERGED] * 2
        assert residual(rows) < 1e-9
        assert np.abs(rows["residual"]).max() < 1e-9 * max(rows["work"])
        assert min(np.diff(rows["material"])) >= 0.0
        lost.append(rows["material"][-1] / max(rows["work"]))
    assert lost[1] > 10.0 * max(lost[0], lost[2])


def test_a_step_that_is_taken_back_leaves_what_was_remembered():
    (((outcomes, rows), memories),) = printed("retried", ())
    before, left, straight, again = map(np.array, memories)
    assert outcomes == [newton.ITERATIONS]
    assert rows["work"] == []
    assert np.abs(before).max() > 0.1 * STRAIN
    np.testing.assert_array_equal(left, before)
    np.testing.assert_array_equal(again, straight)


def test_what_is_stored_is_found_again_after_the_step():
    """No time passes when it is asked for: nothing relaxes."""
    ((once, again),) = printed("kept", ())
    assert once[0] > 0.0
    assert again == pytest.approx(once, rel=1e-12)


def test_shares_of_steps_and_arcs_take_their_share_of_the_time():
    (found,) = printed("timed", ())
    for count, time, steps, rows in found:
        assert steps > rows
        np.testing.assert_allclose(count, time, rtol=1e-12)


def test_a_loaded_wall_creeps_by_the_law_of_its_section():
    """u0 (1 - b / (1 + b) exp(-t / ((1 + b) time))), u0 that of the spring alone."""
    off, lost = [], []
    for outcomes, rows, (at_once, later) in printed("crept", (8,), (16,), (32,)):
        assert outcomes == [newton.CONVERGED]
        spring = (1.0 + BRANCH) * at_once
        share = BRANCH / (1.0 + BRANCH)
        off.append(later / spring - 1.0 + share * math.exp(-1.0 / (1.0 + BRANCH)))
        assert at_once == pytest.approx(1e-5 * 0.1**3 / 3e-5 / (1.0 + BRANCH), rel=1e-4)
        assert rows["material"][-1] > 0.1 * rows["bend"][-1]
        lost.append(rows["integrator"][-1])
    np.testing.assert_allclose([slopes(off), slopes(lost)], 1.0, atol=0.06)
