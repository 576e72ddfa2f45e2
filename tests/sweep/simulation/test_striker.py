"""A rigid striker: momentum and energy, the spring that it meets at best, its stop and rebound."""

import re
from pathlib import Path

import numpy as np
import pytest

from kernels.solve import march, outcomes
from kernels.solve.energy_book import kinetic
from sweep.config.case import Case
from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.scene.lattice import build_scene
from sweep.simulation.filter_class import filtered_force, filtered_peak
from sweep.simulation.simulate import simulate
from tests.studies.verify import MATERIAL
from tests.support.designs.scenes import (
    LOST,
    SEED,
    STORED,
    UNDAMPED,
    VISCOUS,
    is_sound,
    loaded,
    pressed,
    run,
    slopes,
    summed,
)
from tests.support.designs.springs import STIFFNESS, STRIKER, half_swing, spring
from tests.support.kernels.solving import at_rest, go_on, ramp

RECOVERABLE = ("stretch_J", "bend_J", "contact_J")
EULER = "backward_euler"
CREEP = dict(model="rayleigh", mass=200.0, stiffness=5e-3)  # no overshoot


def struck(
    platen="glued",
    friction=0.0,
    damping=UNDAMPED,
    imperfection=0.01,
    steps=None,
    integrator=None,
    **loading,
):
    """A 3 x 3 grid and a striker; ``steps`` in the time that it takes for the height."""
    loads = dict(mode="impact", platen=platen, **loading)
    passage = Case.of(loading=loads).loading.duration / 10
    return Case.of(
        lattice=dict(nodes_per_wall=2, imperfection=imperfection),
        material=MATERIAL,
        loading=loads,
        contact=dict(friction=friction),
        damping=damping,
        solver=dict(joints="points", time_step=steps and passage / steps, integrator=integrator),
    )


def column(steps, damping=UNDAMPED):
    """The spring under 50 g at 20 mm/s."""
    swing = half_swing()
    hit = dict(striker_speed=0.02, duration=2 * swing)
    return spring(swing, steps, EULER, damping, **hit)


def test_a_straight_column_is_a_spring():
    """Peak force v sqrt(k m) of a mass on a spring, to the first order in the time step."""
    peaks, expected = [], 0.02 * np.sqrt(STIFFNESS * STRIKER)
    for steps in (500, 1000, 2000):
        result = run(column(steps))
        assert is_sound(result)
        peaks.append(result.summary["peak_force_N"] / expected - 1.0)
        greatest = result.history["reaction_top_N"].max() / expected - 1.0
        assert greatest == pytest.approx(peaks[-1], abs=1e-4)
    np.testing.assert_allclose(slopes(peaks), 1.0, atol=0.05)
    assert abs(2 * peaks[2] - peaks[1]) < 1e-4
    assert result.summary["rebound_share"] == pytest.approx(1.0, abs=0.006)


def test_the_drag_of_the_lattice_does_not_slow_the_striker():
    drag = dict(model="rayleigh", mass=1e3, stiffness=0.0)
    free, damped = (run(column(500, damping)).summary for damping in (UNDAMPED, drag))
    assert free["rebound_share"] == pytest.approx(damped["rebound_share"], abs=1e-3)


@pytest.mark.parametrize(
    ("platen", "friction", "damping"),
    [("glued", 0.0, UNDAMPED), ("contact", 0.3, SEED), ("contact", 0.3, VISCOUS)],
    ids=["none", "rayleigh", "viscous"],
)
def test_book_of_an_impact(platen, friction, damping):
    result = run(struck(platen, friction, damping))
    history, summary = result.history, result.summary
    assert is_sound(result)
    assert np.ptp(history["work_in_J"]) == 0.0
    assert history["work_in_J"][0] == history["kinetic_J"][0]
    for name in ("dissipated_material_J", "dissipated_friction_J"):
        assert np.diff(history[name]).min() >= -1e-9 * history["work_in_J"][0]
    assert summary["dissipated_energy_J"] == pytest.approx(summed(history, LOST)[-1], rel=1e-12)


@pytest.mark.parametrize(("platen", "friction"), [("glued", 0.0), ("contact", 0.3)])
def test_momentum_goes_into_the_support(platen, friction):
    case = struck(platen, friction, striker_mass=0.05, striker_speed=2.0)
    scene = build_scene(case)
    state = at_rest(scene)
    state.v[:] = scene.velocity
    dt = case.solver.time_step
    up = np.append(np.arange(1, 2 * len(scene.mesh.points), 2), len(state.x) - 1)
    before = np.sum(scene.terms.coordinates.mass[up] * state.v[up])
    outcome, rows = go_on(case, scene, state, ramp(scene, 150, dt))
    assert outcome == outcomes.CONVERGED
    gained = np.sum(scene.terms.coordinates.mass[up] * state.v[up]) - before
    assert gained > 0.01  # N s
    assert np.sum(rows["reaction_bottom"]) * dt == pytest.approx(gained, rel=1e-5)


@pytest.mark.parametrize(
    ("platen", "count", "step_error"),
    [
        ("glued", 400, None),
        ("contact", 40.5, None),
        ("glued", 12.5, None),
        ("contact", 400, 1e-6),
        ("glued", 40.5, 1e-6),
    ],
)
def test_impulse_of_the_striker_s_force_is_its_change_of_momentum(platen, count, step_error):
    """However many steps fill the duration, and however a step is divided."""
    loading = dict(mode="impact", platen=platen, duration=0.02)
    solver = dict(time_step=0.02 / count, step_error=step_error)
    case = Case.of(material=MATERIAL, loading=loading, solver=solver)
    history = run(case).history
    time, speed = history["time_s"], history["striker_speed_m_per_s"]
    impulse = np.cumsum(history["reaction_top_N"][1:] * np.diff(time))
    lost = case.loading.striker_mass * (speed[0] - speed[1:])
    np.testing.assert_allclose(impulse, lost, rtol=1e-12, atol=1e-13)
    assert np.diff(time)[0] == pytest.approx(0.02 / np.ceil(count), rel=1e-12)


@pytest.mark.parametrize("count", [2000, 30.5])
def test_what_pushes_the_striker_is_what_its_support_bears(count):
    """Walls without mass transmit the force of a striker, at the end of a backward Euler step."""
    history = run(column(count / 2)).history
    off = np.abs(history["reaction_top_N"] - history["reaction_bottom_N"])[1:]
    assert off.max() < 2e-3 * history["reaction_bottom_N"].max()


def test_energy_stays_where_nothing_dissipates():
    """Backward Euler's loss vanishes with its step: none is left, extrapolated to a step of 0."""
    lost = []
    for steps in (1000, 2000, 4000):
        heavy = {"striker_mass": 5.0, "striker_speed": 0.1}
        case = struck(imperfection=0.1, steps=steps, integrator=EULER, **heavy)
        history = run(case).history
        lost.append(1.0 - summed(history, STORED)[-1] / history["work_in_J"][-1])
    assert lost[0] > 2.5 * lost[2] > 0.0
    assert abs(2 * lost[2] - lost[1]) < 0.005


def test_stored_energy_of_equal_ends_is_equal():
    """A settled step force and the stop of a slow striker lie on the branch of the crush."""
    crush = run(pressed(3, 0.55, 220)).history
    ends = [(run(loaded(force, "glued", 0.0, 1e-3, CREEP, 0.4, 0.4)), -1) for force in (14.0, 20.0)]
    for energy in (0.045, 0.09):
        result = run(struck(striker_mass=5.0, energy=energy))
        ends.append((result, result.history["top_displacement_m"].argmax()))
    for result, row in ends:
        travel = result.history["top_displacement_m"][row]
        static = np.interp(travel, crush["top_displacement_m"], summed(crush, RECOVERABLE))
        assert summed(result.history, RECOVERABLE)[row] == pytest.approx(static, rel=1e-3)
    assert ends[-1][0].history["contact_J"].max() > 1e-4


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_columns_of_an_impact(platen):
    case = struck(platen, 0.3, SEED, integrator=EULER, striker_mass=0.05, energy=0.1)
    result = run(case)
    history, summary = result.history, result.summary
    stop = history["top_displacement_m"].argmax()
    speed, force = history["striker_speed_m_per_s"], history["reaction_top_N"]
    assert (summary["striker_mass_g"], summary["impact_energy_J"]) == (50.0, 0.1)
    assert summary["striker_speed_m_per_s"] == pytest.approx(2.0) == speed[0]
    assert abs(speed[stop]) < 0.01 * speed[0]
    assert summary["peak_strain"] == pytest.approx(history["strain"][stop])
    travel = -np.cumsum(speed[1:]) * np.diff(history["time_s"])
    np.testing.assert_allclose(history["top_displacement_m"][1:], -travel, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(history["deceleration_m_per_s2"] * 0.05, force, rtol=1e-12)
    assert summary["peak_deceleration_m_per_s2"] == history["deceleration_m_per_s2"].max()
    filtered = filtered_peak(history["time_s"], -speed, 1000)
    assert summary["peak_deceleration_filtered_m_per_s2"] == filtered
    assert 0.3 * summary["peak_deceleration_m_per_s2"] < filtered
    assert filtered < 1.01 * summary["peak_deceleration_m_per_s2"]
    force = history["reaction_bottom_N"]
    time = history["time_s"]
    assert summary["peak_force_N"] == filtered_force(time, force, 1000, (0.0, 0.0)).max()
    assert 0.95 * force.max() < summary["peak_force_N"] < force.max()
    assert summary["rebound_speed_m_per_s"] == -speed.min() > 0.5
    assert summary["returned_energy_J"] == pytest.approx(0.025 * speed.min() ** 2)
    assert summary["rebound_share"] == pytest.approx(summary["returned_energy_J"] / 0.1)
    assert summary["absorbed_energy_J"] == pytest.approx(0.1, rel=0.005)
    grown = Case.of().lattice.outer_size[1] * (1.0 - summary["relative_density"])
    assert summary["stroke_left_m"] == pytest.approx(grown - history["top_displacement_m"].max())


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_work_on_the_lattice_is_the_area_under_the_striker_s_force(platen):
    """Until 20 N are first transmitted; the row that flies with the striker brings its own. The
    force is filtered, so that one above the greatest filtered force is never reached.
    """
    case = struck(platen, 0.3, SEED, striker_mass=0.05, energy=0.1, allowed_forces=(20.0,))
    history, summary = run(case).history, run(case).summary
    force, speed = history["reaction_top_N"], history["striker_speed_m_per_s"]
    way = 0.5 * (speed[1:] + speed[:-1]) * np.diff(history["time_s"])
    carried = history["reaction_bottom_N"]
    passed = filtered_force(history["time_s"], carried, 1000, (0.0, 0.0))
    row = np.argmax(passed > 20.0)
    work = history["work_in_J"][0] - 0.1 + np.cumsum(force[1:] * way)
    assert 0.001 < work[row - 2] <= summary["absorbed_energy_at_20N_J"] <= work[row - 1] < 0.05
    between = 0.5 * (passed.max() + carried.max())
    assert passed.max() < between < carried.max()
    more = run(case.changed(loading={"allowed_forces": (between,)})).summary
    assert more[f"absorbed_energy_at_{between:.10g}N_J"] == more["absorbed_energy_J"]
    assert more["peak_force_until_packed_N"] == more["peak_force_N"]


def test_a_run_ends_when_the_striker_is_back():
    travel = run(struck("contact", 0.3, SEED)).history["top_displacement_m"]
    assert travel[-1] <= 0.0 < travel[1:-1].min()


def test_a_run_ends_when_all_energy_is_spent(monkeypatch):
    """Walls that are damped far more than critically push it back long after."""
    thick = dict(model="rayleigh", mass=0.0, stiffness=0.1)
    hit = dict(striker_speed=2.0, striker_mass=0.05)
    case = struck(damping=thick, steps=2000, integrator="bdf2", **hit)
    ended = simulate(case)
    monkeypatch.setattr("sweep.simulation.simulate.spent", lambda rows: None)
    whole = simulate(case)
    assert ended.status == whole.status == "converged"
    assert ended.history["time_s"][-1] < 0.5 * whole.history["time_s"][-1]
    strains = ended.frames["strain"]
    assert len(strains) > 8
    assert strains.max() > 0.9 * ended.summary["peak_strain"]
    left = sum(ended.history[name] for name in ("kinetic_J", *RECOVERABLE))
    assert left[-1] <= 1e-4 * left[0] < left[-2]
    for name in ("peak_force_N", "peak_strain", "absorbed_energy_J"):
        assert ended.summary[name] == pytest.approx(whole.summary[name], rel=1e-6)
    assert ended.summary["rebound_share"] == pytest.approx(whole.summary["rebound_share"], abs=1e-4)


def test_a_striker_that_still_sinks_is_a_failure():
    result = simulate(struck(striker_mass=1.0, striker_speed=2.0, duration=2e-3))
    assert result.status == "stopped"
    assert "the striker still moves down at strain 0.3" in result.message
    assert "longer loading.duration" in result.message
    assert result.history["time_s"][-1] == pytest.approx(2e-3, rel=0.01)


@pytest.mark.parametrize(
    "shape",
    [
        dict(striker="round", striker_radius=1e-3),
        dict(striker="punch", striker_width=1e-3, striker_tip=1e-4),
    ],
)
def test_a_run_ends_when_the_striker_has_passed_the_lattice(shape, monkeypatch):
    """Without this it goes on to `duration`, and touches nothing any more."""
    hit = dict(striker_mass=0.1, striker_speed=5.0, striker_at=1.0, platen="contact")
    case = struck(duration=2e-2, **hit, **shape)
    ended = simulate(case)
    monkeypatch.setattr("sweep.simulation.simulate._Run._has_passed", lambda run: False)
    whole = simulate(case)
    for result in (ended, whole):
        assert result.status == "slipped"
        assert "the striker has passed the lattice" in result.message
    force, rows = whole.history["reaction_top_N"], len(ended.history["time_s"])
    assert whole.history["time_s"][-1] > 3.0 * ended.history["time_s"][-1]
    np.testing.assert_array_equal(force[:rows], ended.history["reaction_top_N"])
    assert np.abs(force[rows:]).max() < 1e-6 * np.abs(force).max()  # round-off of m v / dt


def test_a_plate_that_presses_the_lattice_below_its_base_has_not_missed_it():
    """Without contact nothing keeps walls above the base."""
    hit = dict(mode="impact", striker_mass=0.5, striker_speed=5.0, duration=5e-3)
    cells = dict(cells_x=2, cells_y=2, nodes_per_wall=2)
    result = simulate(Case.of(lattice=cells, loading=hit, contact={"model": "none"}))
    assert result.status == "slipped"
    assert "pressed the lattice below its base" in result.message
    assert "contact.model" in result.message


def test_a_striker_below_the_base_that_bends_the_lattice_has_not_passed_it():
    """A thin panel between far ribs bends by more than its height, and throws the striker back."""
    panel = dict(kind="square", cells_x=6, cells_y=1, width=0.03, height=2.5e-3)
    panel |= dict(wall_thickness=0.4e-3, nodes_per_wall=2)
    ribs = dict(base="ribs", base_span=0.027, striker="round", striker_radius=3e-3)
    hit = dict(mode="impact", striker_mass=1e-3, striker_speed=3.0, platen="contact")
    result = simulate(Case.of(lattice=panel, material={"name": "cheetah"}, loading=hit | ribs))
    assert result.status == "converged"
    assert result.history["top_displacement_m"].max() > 2.5e-3
    assert result.summary["rebound_speed_m_per_s"] > 0.1
    assert np.isnan(result.summary["stroke_left_m"])  # it bends, and closes no void


def test_a_lattice_that_slips_away_from_a_striker_is_not_ranked():
    """A thin striker at the very side pushes the wall there outwards, not down."""
    lattice = dict(width=0.04, height=0.015, cell_size=5e-3, wall_thickness=0.4e-3)
    pressed = dict(mode="displacement", strain=0.7, platen="contact", unload=False)
    pressed |= dict(striker="round", striker_radius=1e-4)
    tables = dict(lattice=lattice, material=dict(name="cheetah"), solver=dict(load_steps=100))
    side, middle = (
        simulate(Case.of(**tables, loading=pressed | dict(striker_at=at))) for at in (1.0, 0.58)
    )
    assert (middle.status, middle.summary["loaded"]) == ("converged", 1)
    assert (side.status, side.summary["loaded"]) == ("slipped", 0)
    assert re.search(r"the striker lost the lattice: .* loading.striker_at", side.message)
    force = side.history["reaction_top_N"]
    assert force[-1] < 0.1 * force.max()


TALL = dict(
    lattice=dict(
        kind="diamond", cells_x=2, cells_y=20, width=5e-3, height=60e-3, wall_thickness=0.2e-3
    ),
    material=dict(name="ninjaflex"),
    contact=dict(friction=0.0),
)
THIN = dict(
    lattice=dict(cells_x=2, cells_y=16, width=2e-3, height=16e-3, wall_thickness=0.05e-3),
    material=dict(stretch="linear", bend="linear"),
    contact=dict(friction=0.0),
    solver=dict(load_steps=10),
)


@pytest.mark.parametrize("tables", [THIN, TALL], ids=["long steps", "measured curve"])
def test_a_tall_lattice_that_tips_over_between_loose_platens_has_no_place(tables):
    """It turns as a rigid body in one step, stores nothing but round-off, and lies at the end."""
    loading = dict(mode="displacement", strain=0.4, unload=False)
    loose, bonded = (
        simulate(Case.of(**tables, loading=loading | dict(platen=platen)))
        for platen in ("contact", "glued")
    )
    assert (bonded.status, bonded.summary["loaded"]) == ("converged", 1)
    assert (loose.status, loose.summary["loaded"]) == ("slipped", 0)
    assert "the lattice tipped over between the loose platens" in loose.message
    x = loose.frames["position_m"][-1][:, 0]
    assert np.ptp(x) > 4.0 * tables["lattice"]["width"]


def test_a_lattice_that_tips_over_has_no_place_if_unloading_stops(monkeypatch):
    """Its loading is complete, which would rank it."""
    run = march.march

    def stops(terms, tolerance, stage, state, *others):
        if stage.driven1 > stage.driven0:
            return outcomes.STALLED, 0
        return run(terms, tolerance, stage, state, *others)

    monkeypatch.setattr(march, "march", stops)
    loading = dict(mode="displacement", strain=0.4, platen="contact")
    result = simulate(Case.of(**TALL, loading=loading))
    assert (result.status, result.summary["loaded"]) == ("slipped", 0)


def test_a_crush_whose_work_damping_takes_has_not_tipped_over():
    case = Case.of(
        lattice=dict(cells_x=1, cells_y=2, width=0.33e-3, height=1.8e-3, wall_thickness=0.08e-3),
        loading=dict(mode="displacement", strain=0.08, speed=31.0, platen="contact"),
        damping=dict(model="kelvin_voigt", relaxation_time=9.0),
        solver=dict(integrator="backward_euler", time_step=1e-6),
    )
    curves = run(case).history
    assert (curves["stretch_J"] + curves["bend_J"]).max() < 1e-6 * curves["work_in_J"].max()
    assert run(case).status == "converged"


def test_a_rebound_that_is_cut_off_is_a_failure():
    """The striker stops after 5.3 ms and is pushed back for as long."""
    result = simulate(struck(duration=8e-3))
    assert result.status == "stopped"
    assert "the lattice still pushes the striker back at strain" in result.message


def test_a_striker_that_comes_down_again_has_been_stopped():
    """Glued to walls of PLA, which swing: it is at its lowest after 0.9 ms."""
    blow = dict(mode="impact", striker_mass=0.05, striker_speed=20.0, duration=3e-3)
    tables = dict(lattice=dict(cells_x=2, cells_y=2), material=dict(name="pla"))
    result = run(Case.of(**tables, loading=blow, solver=dict(time_step=3e-6)))
    assert result.status == "converged"
    assert result.history["striker_speed_m_per_s"][-1] > 0.0
    lowest = result.history["top_displacement_m"].argmax()
    assert result.history["time_s"][lowest] == pytest.approx(0.9e-3, rel=0.1)


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_the_glued_row_flies_with_the_striker(platen):
    case = struck(platen)
    scene = build_scene(case)
    top = 2 * np.flatnonzero(np.isclose(scene.mesh.points[:, 1], case.lattice.height)) + 1
    assert np.all(scene.velocity[top] == (-2.0 if platen == "glued" else 0.0))
    assert np.count_nonzero(scene.velocity) == (len(top) if platen == "glued" else 0) + 1
    brought = kinetic(scene.velocity, scene.terms.coordinates.mass)
    assert brought == pytest.approx(0.1, rel=0.005)
    assert brought == run(case).history["work_in_J"][0]


def test_the_shipped_sweep_over_hit_energies():
    case = expand(load_config(Path(__file__).parents[3] / "configs" / "impact.toml"))[2]
    assert (case.loading.energy, case.lattice.wall_thickness) == (0.03, 1.2e-3)
    assert case.solver.integrator == "bdf2"
    assert run(case).summary["peak_force_N"] == pytest.approx(77.7, abs=0.4)


def test_the_usual_integrator_of_an_impact_errs_less():
    """Error in the stroke left, in steps of the usual length, against steps of a quarter of it."""

    def left(integrator, steps=1000):
        result = run(struck(damping=SEED, steps=steps, integrator=integrator))
        return result.summary["stroke_left_m"]

    assert struck(damping=SEED).solver.integrator == "bdf2"
    truth = left("bdf2", 4000)
    assert abs(left("bdf2") - truth) < 0.1 * abs(left(EULER) - truth)


def test_the_stroke_left_below_a_tooth_is_known_in_a_crush_too():
    """A crush is marked as doubtful where the tooth goes through the solid, as an impact is."""

    def pressed(**loading):
        lattice = dict(cells_x=6, cells_y=3, width=25e-3, height=12.5e-3)
        loading = dict(mode="displacement", strain=0.2, unload=False) | loading
        case = Case.of(lattice=lattice, loading=loading)
        return run(case).summary, case.lattice.outer_size[1]

    tooth, height = pressed(striker="round")
    voids = (1.0 - tooth["relative_density"]) * height
    assert tooth["stroke_left_m"] == pytest.approx(voids - 0.2 * 12.5e-3)
    assert tooth["bottomed_out"] == 0.0
    assert np.isnan(tooth["rebound_share"])
    assert np.isnan(pressed()[0]["stroke_left_m"])


def under_load(newton, platen):
    """2 x 2 cells under a sudden load."""
    times = dict(duration=5e-3, release_time=5e-3)
    load = dict(mode="force", force=newton, platen=platen, **times)
    cells = dict(cells_x=2, cells_y=2, nodes_per_wall=2)
    stiff = dict(modulus=1e7, density=1000.0, poisson=0.0)
    return Case.of(lattice=cells, material=stiff, loading=load)


@pytest.mark.parametrize(("newton", "closes"), [(1.0, 0.0), (200.0, 1.0)])
def test_a_dead_load_on_a_platen_has_a_stroke_left(newton, closes):
    """The height of walls, not of their centre lines, is that of the voids."""
    case = under_load(newton, "contact")
    summary = simulate(case).summary
    voids = (1.0 - summary["relative_density"]) * case.lattice.outer_size[1]
    assert summary["stroke_left_m"] == pytest.approx(voids - summary["peak_strain"] * case.height)
    assert summary["bottomed_out"] == closes == float(summary["stroke_left_m"] <= 0.0)


def test_a_dead_load_on_nodes_has_no_stroke_left():
    assert np.isnan(simulate(under_load(1.0, "none")).summary["stroke_left_m"])
