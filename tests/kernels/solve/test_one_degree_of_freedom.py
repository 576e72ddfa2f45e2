"""One degree of freedom by hand: every column of the history obeys the scheme's recurrence."""

import numpy as np
import pytest

from kernels.solve import outcomes
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from sweep.simulation.simulate import simulate
from tests.support.designs.scenes import UNDAMPED, unbalanced
from tests.support.designs.tables import MATERIAL
from tests.support.kernels.solving import at_rest, go_on, ramp

DT = 5e-5
RAYLEIGH = dict(model="rayleigh", mass=2000.0, stiffness=3e-5)
VISCOUS = dict(model="kelvin_voigt", relaxation_time=3e-5)
DAMPINGS = pytest.mark.parametrize(
    "damping", [UNDAMPED, RAYLEIGH, VISCOUS], ids=lambda damping: damping["model"]
)
EXACT = {"force": 1e-13, "decrement": 1e-25}


def single(loading, damping=UNDAMPED, **solver):
    """One cell of single elements, straight: its top row goes up and down on two springs."""
    return Case.of(
        lattice=dict(cells_x=1, cells_y=1, nodes_per_wall=0, imperfection=0.0),
        material=MATERIAL,
        loading=loading,
        contact=dict(model="none"),
        damping=damping,
        solver=dict(tolerance=1e-12, joints="points", **solver),
    )


def springs(case):
    """Stiffness (N/m) of the two walls upwards, and the mass (kg) that they carry."""
    lattice, scene = case.lattice, build_scene(case)
    top = 2 * np.flatnonzero(scene.mesh.points[:, 1] > 0.5 * lattice.height) + 1
    stiffness = 2 * MATERIAL.modulus * lattice.depth * lattice.wall_thickness / lattice.height
    return stiffness, scene.terms.coordinates.mass[top].sum()


def drag_of(model, stiffness, mass):
    """Damping constants (N s/m) of a body that moves alone, and of damping between top and
    bottom.
    """
    return {
        "none": (0.0, 0.0),
        "rayleigh": (RAYLEIGH["mass"] * mass, RAYLEIGH["stiffness"] * stiffness),
        "kelvin_voigt": (0.0, VISCOUS["relaxation_time"] * stiffness),
    }[model]


def check_columns(history, expected):
    """Columns are as expected; those that are zero, or nearly, in comparison with the work."""
    work = expected["work_in_J"].max()
    for name, column in expected.items():
        size = work if name == "dissipated_integrator_J" else np.abs(column).max() or work
        np.testing.assert_allclose(history[name], column, rtol=0, atol=1e-8 * size, err_msg=name)


def running(gains):
    """Sums so far, with the 0 they start from."""
    return np.concatenate([[0.0], np.cumsum(gains)])


SHARES = (1 / 16, 1 / 16, 1 / 8, 1 / 4, 1 / 2)  # of the first step after a sudden change


def stiffly(scheme, past, dt, last, system, force):
    """The next (y, v, a) of M y'' + C y' + K y = F by the formulas of textbooks; last: dt before.

    Without one it is a step of backward Euler. BDF2: Hairer, Norsett & Wanner, Solving Ordinary
    Differential Equations I, III.5, of variable step. newmark: beta 1/4, gamma 1/2.
    """
    mass, drag, stiffness = system
    (y, v, a), (older_y, older_v, _) = past[-1], past[-2]
    if scheme == "newmark" and last:
        ahead, rate = y + dt * v + dt**2 / 4 * a, v + dt / 2 * a
        a = (force - drag * rate - stiffness * ahead) / (
            mass + drag * dt / 2 + stiffness * dt**2 / 4
        )
        return ahead + dt**2 / 4 * a, rate + dt / 2 * a, a
    r = dt / last if last else 0.0
    now, before, oldest = (1 + 2 * r) / (1 + r) / dt, (1 + r) / dt, r**2 / (1 + r) / dt
    rest_y, rest_v = oldest * older_y - before * y, oldest * older_v - before * v
    push = force - mass * (now * rest_y + rest_v) - drag * rest_y
    y = push / (mass * now**2 + drag * now + stiffness)
    v = now * y + rest_y
    return y, v, now * v + rest_v


@pytest.mark.parametrize("scheme", ["backward_euler", "bdf2", "newmark"])
@DAMPINGS
def test_book_of_an_oscillator_is_the_closed_form_of_the_scheme(damping, scheme):
    """A load on two springs, taken off again: every row and column by hand. Work and losses are by
    trapezoids but in first steps, and in all of backward Euler.
    """
    force, held, steps, first = 0.2, 20, 45, scheme == "backward_euler"
    loading = dict(force=force, release_time=held * DT, duration=steps * DT)
    case = single(loading, damping, time_step=DT, integrator=scheme)
    history = simulate(case).history
    stiffness, mass = springs(case)
    alone, between = drag_of(damping["model"], stiffness, mass)
    drag, pushed = alone + between, np.where(np.arange(steps) < held, force, 0.0)
    past, books = [(0.0, 0.0, 0.0)] * 2, [np.zeros(3)]
    rows, last = [(0.0, 0.0, *books[0])], 0.0
    for k in range(steps):
        sudden = k in (0, held)
        last = 0.0 if sudden or first else last
        for share in SHARES if sudden and not first else (1.0,):
            dt = share * DT
            past.append(stiffly(scheme, past, dt, last, (mass, drag, stiffness), pushed[k]))
            (y0, v0, a0), (y, v, a) = past[-2:]
            w = 0.5 if last else 1.0
            lost = drag * (w * v + (1 - w) * v0) * (y - y0)
            inert = mass * (w * a + (1 - w) * a0) * (y - y0) - 0.5 * mass * (v**2 - v0**2)
            sprung = stiffness * ((w * y + (1 - w) * y0) * (y - y0) - 0.5 * (y**2 - y0**2))
            books.append(books[-1] + (pushed[k] * (y - y0), lost, inert + sprung))
            last = dt
        rows.append((y, v, *books[-1]))
    y, v, work, lost, integrator = np.array(rows).T
    expected = {
        "top_displacement_m": y,
        "kinetic_J": 0.5 * mass * v**2,
        "stretch_J": 0.5 * stiffness * y**2,
        "bend_J": 0.0 * y,
        "work_in_J": work,
        "dissipated_material_J": lost,
        "dissipated_integrator_J": integrator,
        "reaction_top_N": np.append(0.0, pushed),
        "reaction_bottom_N": stiffness * y + between * v,
        "energy_residual_J": 0.0 * y,
        "time_s": np.arange(steps + 1) * DT,
    }
    if first:  # as all is linear
        expected["newton_iterations"] = np.minimum(np.arange(steps + 1), 1)
    assert np.ptp(v) * DT > 0.1 * np.ptp(y)
    check_columns(history, expected)


@DAMPINGS
def test_book_of_a_driven_row_is_the_closed_form_of_the_scheme(damping):
    """The platen starts at its full speed: mass, springs and damping all push back."""
    speed, steps = 0.1, 20
    loading = dict(mode="displacement", stroke=speed * steps * DT, speed=speed, unload=True)
    case = single(loading, damping, load_steps=steps, integrator="backward_euler")
    history = simulate(case).history
    y = np.concatenate([np.arange(steps + 1), np.arange(steps)[::-1]]) * speed * DT
    v = np.append(0.0, np.diff(y) / DT)
    stiffness, mass = springs(case)
    alone, between = drag_of(damping["model"], stiffness, mass)
    force = stiffness * y + (alone + between) * v + mass * np.diff(v, prepend=0.0) / DT
    expected = {
        "top_displacement_m": y,
        "reaction_top_N": force,
        "reaction_bottom_N": stiffness * y + between * v,
        "kinetic_J": 0.5 * mass * v**2,
        "stretch_J": 0.5 * stiffness * y**2,
        "work_in_J": running(force[1:] * np.diff(y)),
        "dissipated_material_J": running((alone + between) * np.diff(y) ** 2 / DT),
        "time_s": np.arange(2 * steps + 1) * DT,
    }
    check_columns(history, expected)
    assert unbalanced(history) < 1e-9


def test_a_static_load_that_grows_does_half_of_its_work():
    case = single(dict(force=0.2))
    scene = build_scene(case)
    state = at_rest(scene)
    outcome, rows = go_on(case, scene, state, ramp(scene, 3, factor=(0.0, 1.0)), **EXACT)
    assert outcome == outcomes.CONVERGED
    share = np.array([1, 2, 3]) / 3
    full = 0.5 * 0.2**2 / springs(case)[0]
    np.testing.assert_allclose(rows["reaction_top"], 0.2 * share, rtol=1e-12)
    np.testing.assert_allclose(rows["work"], full * share**2, rtol=1e-9)
    np.testing.assert_allclose(rows["stretch"], full * share**2, rtol=1e-9)
    assert np.abs(rows["integrator"]).max() < 1e-9 * full
