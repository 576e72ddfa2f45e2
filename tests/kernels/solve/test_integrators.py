"""Integrators in time: their orders, energy, and steps chosen by their error."""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.studies.validation import energy
from tests.studies.validation.energy import moving
from tests.support.designs import scenes
from tests.support.designs.scenes import SEED, UNDAMPED, VISCOUS, pressed, run, slopes, unbalanced
from tests.support.designs.structures import APART, set_off
from tests.support.designs.tables import MATERIAL

ORDERS = {"backward_euler": 1, "bdf2": 2, "newmark": 2}
INTEGRATORS = pytest.mark.parametrize("integrator", ORDERS)
HIGHER = pytest.mark.parametrize("integrator", ["bdf2", "newmark"])
NAMES = ["none", "drag", "rayleigh", "viscous"]
DRAG = dict(model="rayleigh", mass=100.0, stiffness=0.0)
STIFF = dict(model="rayleigh", mass=0.0, stiffness=5e-4)
CREEP = dict(model="kelvin_voigt", relaxation_time=5e-4)
SOFT = dict(model="rayleigh", mass=300.0, stiffness=3e-5)
TIMES = 25  # at which runs are compared


def loaded(duration, steps, integrator, damping, platen="none", release=0.5, **loading):
    """A grid under a dead load, let go after a share of the duration; friction on a platen."""
    loads = dict(platen=platen, duration=duration, release_time=release * duration, **loading)
    touch = {"none": APART, "contact": dict(friction=0.3, slip_speed=0.5)}[platen]
    solver = dict(
        time_step=duration / steps, integrator=integrator, tolerance=1e-10, joints="points"
    )
    return Case.of(
        material=MATERIAL, loading=loads, contact=touch, damping=damping, solver=solver
    )  # fmt: skip


def struck(integrator, steps, duration, friction=None, damping=SOFT, **loading):
    """A grid hit by 50 g, glued if there is no friction."""
    touch = APART if friction is None else dict(friction=friction)
    loads = dict(striker_mass=0.05, duration=duration, **loading)
    solver = dict(time_step=duration / steps, integrator=integrator)
    return Case.of(
        lattice=dict(nodes_per_wall=2),
        material=MATERIAL,
        loading=loads,
        contact=touch,
        damping=damping,
        solver=solver,
    )


def orders(cases, column, status):
    """Slopes of the differences of runs with 1, 2, 4... times as many steps, rms over time."""
    results = [run(case) for case in cases]
    assert {result.status for result in results} == {status}
    values = [result.history[column] for result in results]
    seen = [column[:: (len(column) - 1) // TIMES] for column in values]
    return slopes([np.sqrt(np.mean((b - a) ** 2)) for a, b in pairwise(seen)])


def check_orders(case, integrator, steps, columns, atol=0.15, status="converged"):
    """case(steps): as many as ``steps`` and 2 and 4 times as many, or 8 times of first order."""
    finer = 4 // ORDERS[integrator]
    cases = [case(n * steps * finer) for n in (1, 2, 4)]
    for column in columns:
        found = orders(cases, column, status)
        np.testing.assert_allclose(found, ORDERS[integrator], atol=atol, err_msg=column)


MOTION = ["probe_3_x_m", "probe_3_y_m", "probe_3_rotation_rad"]
ENERGIES = ["stretch_J", "bend_J", "kinetic_J", "dissipated_integrator_J"]


@INTEGRATORS
@pytest.mark.parametrize("damping", [UNDAMPED, DRAG, STIFF, CREEP], ids=NAMES)
def test_orders_of_a_beam_that_swings_far(damping, integrator):
    """A quarter of a period of a beam so thick that its steps resolve its length's too."""
    period, parts = set_off(3, 0.2, 20.0)

    def case(steps):
        return moving(parts, 0.25 * period, steps, integrator, damping)

    lost = ["dissipated_material_J"] if damping != UNDAMPED else []
    check_orders(case, integrator, 200, [*MOTION, *ENERGIES, *lost])


@INTEGRATORS
def test_orders_of_a_load_that_comes_and_goes_at_once(integrator):
    def case(steps):
        return loaded(4e-4, steps, integrator, SOFT, force=5.0)

    columns = ["strain", *ENERGIES, "work_in_J", "reaction_bottom_N"]
    check_orders(case, integrator, 200, columns)


@INTEGRATORS
def test_orders_of_a_strike(integrator):
    """Until the striker turns, with its row and without: its run ends too early."""
    columns = ["strain", "striker_speed_m_per_s", "stretch_J", "bend_J", "kinetic_J"]
    check_orders(
        lambda steps: struck(integrator, steps, 2.5e-3, striker_speed=0.5),
        integrator, 100, columns, status="stopped",
    )  # fmt: skip


def rubbed(integrator, steps):
    """A plate lies on a grid that creeps under it."""
    damping = dict(model="rayleigh", mass=300.0, stiffness=3e-4)
    return loaded(5e-3, steps, integrator, damping, "contact", 1.0, force=3.0)


@pytest.mark.parametrize(("integrator", "steps"), [("bdf2", 600), ("newmark", 200)])
def test_orders_of_contact_and_friction(integrator, steps):
    """Friction depends on the speed of slip, whatever the length of the steps and the scheme."""
    columns = ["strain", "contact_J", "work_in_J"]
    check_orders(partial(rubbed, integrator), integrator, steps, columns, atol=0.2)
    lost = [run(rubbed(each, 1600)).history["dissipated_friction_J"][-1] for each in ORDERS]
    assert lost[1] == pytest.approx(lost[2], rel=5e-3)


@HIGHER
def test_orders_of_a_platen_that_moves_and_turns(integrator):
    """The platen has its speed at once, which costs the energy of an inelastic impact."""

    def case(steps):
        numerics = {"integrator": integrator, "tolerance": 1e-10}
        there = {"speed": 0.1, "unload": True, "damping": SOFT}
        return pressed(3, 0.01, steps, contact="none", solver=numerics, **there)

    columns = ["reaction_top_N", "reaction_bottom_N", "stretch_J", "kinetic_J"]
    check_orders(case, integrator, 200, columns)


@pytest.mark.parametrize(("integrator", "least", "most"), [
    ("backward_euler", -1.01, -0.99), ("bdf2", -0.5, -0.4), ("newmark", -1e-4, 1e-4),
])  # fmt: skip
def test_energy_of_a_beam_in_a_hundred_periods(integrator, least, most):
    """Fifty steps a period of the first mode, 1 % of the length wide."""
    result = energy.cantilever(integrator)
    drift = energy.gained(result)
    assert least < drift[-1] < most
    assert np.abs(drift).max() < max(abs(least), abs(most))
    assert unbalanced(result.history) < 1e-5


@pytest.mark.parametrize(("integrator", "lost"), [("backward_euler", 1.41), ("bdf2", 0.476)])
def test_a_stiff_pendulum_is_safe_with_damped_integrators(integrator, lost):
    """They lose the same however stiff it is."""
    for modulus in (energy.SOFT, energy.STIFF):
        result = energy.pendulum(integrator, modulus)
        assert result.status == "converged"
        assert energy.gained(result)[-1] == pytest.approx(-lost, rel=0.02)


def test_newmark_takes_shares_of_the_steps_in_which_it_would_make_energy():
    """It keeps the energy of a soft pendulum; of a stiff one it would make many times as much."""
    soft, stiff = (energy.pendulum("newmark", y) for y in (energy.SOFT, energy.STIFF))
    assert (soft.status, stiff.status) == ("converged", "converged")
    assert abs(energy.gained(soft)[-1]) < 0.02
    assert energy.gained(stiff).max() < 0.05
    assert stiff.summary["steps"] > 2 * soft.summary["steps"]


SCENES = {
    "dead load": lambda how, damping, friction: scenes.loaded(
        10.0, "contact", friction, 1e-4, damping, 0.025, 0.05
    ).changed(solver={"integrator": how}),
    "platen": lambda how, damping, friction: pressed(
        3, 0.5, 100, "contact", friction, unload=True, speed=0.1, damping=damping,
        solver={"integrator": how},
    ),
    "striker": lambda how, damping, friction: struck(
        how, 2000, 0.06, friction, damping, platen="contact"
    ),
}  # fmt: skip


@INTEGRATORS
@pytest.mark.parametrize(
    ("damping", "friction"), [(SEED, 0.3), (VISCOUS, 0.0)], ids=["rayleigh", "viscous"]
)
@pytest.mark.parametrize("scene", SCENES)
def test_book_closes(scene, friction, damping, integrator):
    """With backward Euler losses only grow, but for friction, whose normal forces lag."""
    result = run(SCENES[scene](integrator, damping, friction))
    history, first = result.history, integrator == "backward_euler"
    most = history["work_in_J"].max()
    assert result.status == "converged"
    assert unbalanced(history) < 1e-6
    for name, acts in (("dissipated_material_J", True), ("dissipated_friction_J", friction > 0.0)):
        book = history[name]
        assert (book[-1] > 0.0) == acts
        assert not first or np.diff(book).min() >= -1e-10 * most - 1e-4 * book[-1]
    assert history["contact_J"].max() > 0.0
    assert first or abs(history["dissipated_integrator_J"][-1]) < 0.15 * most


@HIGHER
def test_book_closes_over_halved_steps(integrator):
    """A step that fails is made in parts, each a step of its own length."""
    few = {"integrator": integrator, "max_iterations": 3}
    result = run(pressed(3, 0.3, 10, unload=True, speed=0.1, damping=SEED, solver=few))
    assert result.status == "converged"
    assert result.summary["steps"] > 40
    assert unbalanced(result.history) < 1e-6


def released(integrator, time_step, step_error=None):
    """A grid under 5 N, let go."""
    case = scenes.loaded(5.0, time_step=time_step, damping=CREEP, release_time=0.01, duration=0.02)
    numerics = {"integrator": integrator, "step_error": step_error, "tolerance": 1e-9}
    return case.changed(solver=numerics)


def missed(result, exact):
    """Error of the strain, rms over the rows, as a share of its range."""
    strain = np.interp(result.history["time_s"], exact["time_s"], exact["strain"])
    return np.sqrt(np.mean((result.history["strain"] - strain) ** 2)) / np.ptp(strain)


@INTEGRATORS
def test_steps_by_their_error(integrator):
    """The error falls with the allowed one; twice as many fixed steps have a larger error."""
    exact = run(released("newmark", 2e-6)).history
    kept = [run(released(integrator, 1e-3, allowed)) for allowed in (1e-5, 1e-6, 1e-7)]
    assert all(unbalanced(result.history) < 1e-9 for result in kept)
    assert {len(result.history["strain"]) for result in kept} == {21}
    errors = [missed(result, exact) for result in kept]
    assert errors[0] > 2.0 * errors[1] > 4.0 * errors[2]
    fixed = run(released(integrator, 0.02 / (2 * kept[-1].summary["steps"])))
    assert missed(fixed, exact) > 1.5 * errors[2]
    refused = simulate(released(integrator, 1e-3, 1e-30))
    assert refused.status == "stopped"
    assert "no step was short enough for solver.step_error" in refused.message
