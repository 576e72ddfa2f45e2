"""A base that moves freely: closed forms, momentum, the book, and the fixed base as its limit."""

import numpy as np
import pytest

from kernels.solve.march import march
from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError
from sweep.scene.lattice import build_scene
from sweep.scene.sides import build_tied
from sweep.simulation.simulate import simulate
from tests.support.designs.scenes import is_sound, run, unbalanced
from tests.support.designs.springs import STIFFNESS, half_swing, spring
from tests.support.designs.springs import STRIKER as MASS

TARGET, SPEED = 0.2, 0.5  # kg, m/s
REDUCED = MASS * TARGET / (MASS + TARGET)
SWING = half_swing(REDUCED)
CELLS = dict(kind="hex", cells_x=3, cells_y=3, wall_thickness=1e-3)


def column(damping=None):
    """The spring between striker and target."""
    hit = dict(striker_speed=SPEED, target_mass=TARGET, duration=2 * SWING)
    return spring(SWING, damping=damping, **hit)


def hit(platen, target=TARGET, solver=None, damping=None, sides="free", **shape):
    """Hexagons under a striker, flat on a flat base unless they have another ``shape``."""
    loading = dict(striker_mass=MASS, striker_speed=2.0, platen=platen, target_mass=target) | shape
    lattice = CELLS | {"sides": sides}
    return Case.of(lattice=lattice, loading=loading, solver=solver or {}, damping=damping or {})


def test_two_masses_and_a_spring():
    """Stroke v sqrt(m' / k) with m' = m M / (m + M); then u = 2 m v / (m + M), w = u - v."""
    result = run(column())
    history, summary = result.history, result.summary
    assert is_sound(result)
    exact = SPEED * SWING / np.pi * np.sin(np.pi * history["time_s"] / SWING)
    deepest = SPEED * np.sqrt(REDUCED / STIFFNESS)
    np.testing.assert_allclose(history["top_displacement_m"], exact, atol=1e-5 * deepest)
    assert summary["indentation_m"] == pytest.approx(deepest, rel=1e-6)
    assert summary["absorbed_energy_J"] == pytest.approx(0.5 * REDUCED * SPEED**2, rel=1e-5)
    after = 2 * MASS * SPEED / (MASS + TARGET)
    assert summary["target_speed_m_per_s"] == pytest.approx(after, rel=1e-5)
    assert history["striker_speed_m_per_s"][-1] == pytest.approx(after - SPEED, rel=1e-4)
    assert summary["rebound_speed_m_per_s"] == pytest.approx(SPEED, rel=1e-5)
    assert summary["rebound_share"] == pytest.approx(1.0, abs=1e-5)
    assert summary["lost_share"] == pytest.approx(0.0, abs=1e-5)
    force = STIFFNESS * deepest
    assert summary["peak_force_N"] == pytest.approx(force, rel=1e-4)
    felt = summary["peak_target_acceleration_m_per_s2"]
    assert felt == pytest.approx(force / TARGET, rel=1e-4)
    assert summary["base_impulse_Ns"] == pytest.approx(TARGET * after, rel=1e-5)


def test_restitution():
    """A damped spring: e = exp(-pi d / sqrt(1 - d^2)) with d = c / (2 sqrt(k m')), c = beta k.

    That is the speed as the spring is as long as at first, where it still pulls: the greatest one
    is earlier, as the dashpot pulls before.
    """
    beta = 0.1 * SWING / np.pi
    result = run(column(damping=dict(model="rayleigh", mass=0.0, stiffness=beta)))
    history, ratio = result.history, 0.5 * beta * np.pi / SWING
    root = np.sqrt(1 - ratio**2)
    apart = history["target_speed_m_per_s"] - history["striker_speed_m_per_s"]
    back = np.interp(0.0, -history["top_displacement_m"][-9:], apart[-9:])
    assert back == pytest.approx(SPEED * np.exp(-np.pi * ratio / root), rel=1e-4)
    share = result.summary["rebound_share"]
    assert share == pytest.approx((apart.max() / SPEED) ** 2, rel=1e-9)
    assert result.summary["lost_share"] == pytest.approx(1.0 - share, rel=1e-9)


@pytest.mark.parametrize(
    ("platen", "integrator", "shape"),
    [
        ("glued", "bdf2", {}),
        ("glued", "newmark", {}),
        ("contact", "bdf2", {}),
        ("contact", "newmark", {}),
        ("glued", "bdf2", {"striker": "round", "striker_radius": 5e-3}),
        ("contact", "bdf2", {"base": "ribs", "base_span": 8e-3}),
        ("glued", "newmark", {"sides": "periodic"}),
        ("sliding", "bdf2", {"sides": "periodic"}),
        ("contact", "bdf2", {"sides": "periodic"}),
    ],
)
def test_momentum_and_book(platen, integrator, shape, monkeypatch):
    """The momentum of striker, lattice and target is that at first, in the whole run."""
    case, states = hit(platen, solver=dict(integrator=integrator), **shape), []

    def follow(terms, tolerance, stage, state, *others):
        ended = march(terms, tolerance, stage, state, *others)
        mass, tall = terms.coordinates.mass, np.ones(state.v.size, bool)
        tall[: 2 * terms.layout.n_nodes : 2] = False
        states.append(float(np.sum(mass[tall] * state.v[tall])))
        return ended

    monkeypatch.setattr("kernels.solve.march.march", follow)
    result = simulate(case)
    scene = build_tied(case) if case.lattice.tied_sides else build_scene(case)
    at_first = float(np.sum(scene.terms.coordinates.mass * scene.velocity))
    assert result.summary["status"] == "converged"
    assert len(states) > 5
    np.testing.assert_allclose(states, at_first, rtol=1e-6)
    assert unbalanced(result.history) < 1e-6
    moving = 0.5 * TARGET * result.history["target_speed_m_per_s"] ** 2
    assert np.all(result.history["kinetic_J"] >= moving)
    assert moving[-1] > 0.1 * result.history["work_in_J"][0]


@pytest.mark.parametrize("sides", ["free", "periodic"])
@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_a_heavy_target_is_a_fixed_base(platen, sides):
    """The difference falls as striker / target; the default of a fixed base has no column of it."""
    fixed = run(hit(platen, target=None, damping=dict(mass=0.0), sides=sides))
    names = ("peak_force_N", "absorbed_energy_J", "indentation_m", "base_impulse_Ns")
    for target in (5.0, 500.0):
        steps = dict(time_step=fixed.case.solver.time_step)
        heavy = run(hit(platen, target, solver=steps, sides=sides))
        for name in names:
            assert heavy.summary[name] == pytest.approx(
                fixed.summary[name], rel=1.5 * MASS / target
            )
    for name in ("target_speed_m_per_s", "peak_target_acceleration_m_per_s2"):
        assert np.isnan(fixed.summary[name])
    assert not fixed.history["target_speed_m_per_s"].any()


def test_a_target_of_a_tonne_leaves_more_in_the_book():
    """Residuals below the round-off of its inertia are admissible for all coordinates."""
    light, heavy = (unbalanced(run(hit("contact", target)).history) for target in (TARGET, 1000.0))
    assert light < 1e-9 < heavy < 1e-5


def test_steps_follow_the_reduced_mass():
    slow = dict(striker_mass=1e-4, striker_speed=0.1)
    fixed, free = (
        Case.of(loading=slow | more).solver.time_step for more in ({}, {"target_mass": 1e-4 / 3})
    )
    assert free == pytest.approx(0.5 * fixed)


@pytest.mark.parametrize(
    ("tables", "refused"),
    [
        (
            {"loading": {"gravity": True}},
            "loading.gravity = True; allowed: false if loading.target",
        ),
        ({"loading": {"direction": "out_of_plane"}}, "loading.direction = out_of_plane; allowed: "),
        ({"contact": {"model": "position_based"}}, r"if loading\.target_mass is given"),
        ({"damping": {"mass": 5.0}}, "damping.mass = 5.0; allowed: 0 if loading.target_mass"),
    ],
)
def test_what_a_target_does_not_have(tables, refused):
    """Nothing holds a lattice back in space."""
    assert Case.of(loading={"target_mass": 1.36}).damping.mass == 0.0
    with pytest.raises(RefusedError, match=refused):
        Case.of(**tables | {"loading": {"target_mass": 1.36} | tables.get("loading", {})})
