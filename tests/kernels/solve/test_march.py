"""Steps through a stage: falling, flying and sliding bodies; halved steps; interruptions."""

from unittest.mock import patch

import numpy as np
import pytest

from kernels.geometry import near_pairs
from kernels.geometry.distance import squared_distance
from kernels.shared.rows import CONTACT
from kernels.solve import outcomes
from kernels.solve.energy_book import kinetic
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from sweep.simulation.simulate import simulate
from tests.kernels.solve.test_newton import BUCKLED, column
from tests.kernels.solve.test_one_degree_of_freedom import DAMPINGS, DT
from tests.support.designs.scenes import TIGHT, UNDAMPED, pressed, unbalanced
from tests.support.designs.tables import MATERIAL
from tests.support.kernels.solving import at_rest, floating, go_on, ramp
from tests.support.kernels.states import nodes
from tests.support.kernels.terms import touch_of

GRAVITY = 1e4  # m/s^2


def loose(damping=UNDAMPED, friction=0.0, speed=0.0):
    """A floating 2 x 2 grid; the side walls of its lower left cell fly at one another."""
    case = Case.of(
        lattice=dict(cells_x=2, cells_y=2, wall_thickness=1.2e-3),
        material=MATERIAL,
        loading=dict(force=1.0),
        contact=dict(friction=friction, slip_speed=0.1),
        damping=damping,
        solver=dict(time_step=DT),
    )
    scene = floating(case)
    scene.terms.coordinates.load[:] = 0.0
    state, points = at_rest(scene), scene.mesh.points / (case.lattice.width, case.lattice.height)
    for side, way in ((0.0, 1.2), (0.5, -1.0)):
        inner = (abs(points[:, 0] - side) < 0.05) & (points[:, 1] > 0.05) & (points[:, 1] < 0.45)
        state.v[2 * np.flatnonzero(inner)] = way * speed
        state.v[2 * np.flatnonzero(inner) + 1] = 0.3 * way * speed
    state.book[0].work = kinetic(state.v, scene.terms.coordinates.mass)  # what set it off
    return case, scene, state


@pytest.mark.parametrize("drag", [0.0, 300.0])
def test_free_fall_follows_the_recurrence_of_backward_euler(drag):
    """Nothing in the lattice stirs: v' = (v + a dt) / (1 + drag dt), y' = y + v' dt."""
    damping = dict(model="rayleigh", mass=drag, stiffness=1e-4) if drag else UNDAMPED
    case, scene, state = loose(damping)
    masses, upwards = scene.terms.coordinates.mass, slice(1, 2 * len(scene.mesh.points), 2)
    mass = 0.5 * masses.sum()
    scene.terms.coordinates.load[upwards] = -GRAVITY * masses[upwards]
    outcome, rows = go_on(case, scene, state, ramp(scene, 12, DT, (1.0, 1.0)), force=1e-10)
    assert outcome == outcomes.CONVERGED
    v = np.zeros(13)
    for k in range(12):
        v[k + 1] = (v[k] + GRAVITY * DT) / (1.0 + drag * DT)
    v, y = v[1:], np.cumsum(v[1:]) * DT
    np.testing.assert_allclose(state.v[upwards], -v[-1], rtol=1e-8)
    fallen = scene.x_rest.copy()
    fallen[upwards] -= y[-1]
    np.testing.assert_allclose(state.x, fallen, rtol=0, atol=1e-9 * y[-1])
    for name, expected in (
        ("work", GRAVITY * mass * y),
        ("kinetic", 0.5 * mass * v**2),
        ("integrator", 0.5 * mass * np.cumsum(np.diff(v, prepend=0.0) ** 2)),
        ("material", drag * DT * mass * np.cumsum(v**2)),
    ):
        np.testing.assert_allclose(rows[name], expected, rtol=1e-7, atol=1e-20)


def momentum(scene, state):
    return nodes(scene, scene.terms.coordinates.mass * state.v)


@pytest.mark.parametrize("friction", [0.0, 0.3])
@DAMPINGS
def test_what_nothing_holds_keeps_its_momentum(damping, friction):
    """Walls collide in flight. Drag on the mass alone slows it, by 1 / (1 + alpha dt) a step.

    Forces between walls, taken where a step ends, have no moment either; only forces of Rayleigh
    damping and of friction act at the place where it began.
    """
    case, scene, state = loose(damping, friction, 150.0)
    kept, whole, touched = 1.0 / (1.0 + damping.get("mass", 0.0) * DT), 0, 0.0
    for _ in range(12):
        before, taken = momentum(scene, state), state.totals[0].steps
        outcome, rows = go_on(case, scene, state, ramp(scene, 1, DT), force=1e-9)
        assert outcome == outcomes.CONVERGED
        assert abs(rows[0].residual) < 1e-9 * rows[0].kinetic
        touched = max(touched, rows[0].contact)
        if state.totals[0].steps > taken + 1:
            continue
        whole += 1
        after = momentum(scene, state)
        allowed = 1e-9 * np.abs(before).sum()
        drift = after.sum(axis=0) - kept * before.sum(axis=0)
        np.testing.assert_allclose(drift, 0.0, atol=allowed)
        (x, y), (px, py) = nodes(scene, state.x).T, (after - before).T
        if damping["model"] != "rayleigh" and friction == 0.0:
            assert abs(np.sum(x * py - y * px)) < allowed * case.lattice.height
    assert whole > 8
    assert touched > 1e-3 * rows[0].bend
    assert (rows[0].friction > 0.0) == (friction > 0.0)


def test_contact_energy_and_gap_are_those_of_all_pairs():
    """Pairs are listed anew before any that matters is missed."""
    case, scene, state = loose(speed=150.0)
    touch, near = scene.terms.contact, 0
    for _ in range(12):
        _, rows = go_on(case, scene, state, ramp(scene, 3, DT))
        everything = near_pairs.find(state.x, touch, case.lattice.width)
        energy = touch_of(touch, everything, state.x).energy(state.x)
        assert state.stored[CONTACT] == pytest.approx(energy, rel=1e-12, abs=1e-18)
        ends, start = touch.edges[everything.edge], everything.d_contact
        listed = zip(everything.node, ends, start, strict=True)
        gaps = [
            (squared_distance(state.x, p, *at) ** 0.5, dc)
            for k, (p, at, dc) in enumerate(listed)
            if not near_pairs.is_guarded(everything, k, touch)
        ]
        gap, _ = min(gaps)
        assert (energy > 0.0) == any(d < dc for d, dc in gaps)
        if gap < touch.reach:
            near += energy > 0.0
            assert rows[-1].gap == pytest.approx(gap, rel=1e-12)
    assert near > 2


def sliding():
    """A grid between the platens, under 3 N, that slides along both at 2 m/s."""
    case = Case.of(
        lattice=dict(cells_x=2, cells_y=2, wall_thickness=1.2e-3),
        material=MATERIAL,
        loading=dict(force=3.0, platen="contact"),
        contact=dict(friction=0.3, slip_speed=1e-3),
        damping=UNDAMPED,
        solver=dict(time_step=DT),
    )
    scene = build_scene(case)
    state = at_rest(scene)
    outcome, _ = go_on(case, scene, state, ramp(scene, 5, factor=(0.0, 1.0)))
    assert outcome == outcomes.CONVERGED
    state.v[: 2 * len(scene.mesh.points) : 2] = 2.0
    state.book[0].work += kinetic(state.v, scene.terms.coordinates.mass)
    return case, scene, state


def test_friction_slows_what_slides_by_mu_times_the_forces_on_it():
    """3 N from above; from below the remaining force after the grid had been accelerated in the
    previous step.
    """
    case, scene, state = sliding()
    go_on(case, scene, state, ramp(scene, 1, DT, (1.0, 1.0)))
    least, most, begun, rise = 0.0, 0.0, state.book.copy()[0], None
    for _ in range(5):
        before, x = momentum(scene, state).sum(axis=0), state.x.copy()
        outcome, rows = go_on(case, scene, state, ramp(scene, 1, DT, (1.0, 1.0)))
        assert outcome == outcomes.CONVERGED
        change = (momentum(scene, state).sum(axis=0) - before) / DT
        if rise is not None:
            assert change[0] == pytest.approx(-0.3 * (3.0 + 3.0 + rise), rel=1e-5)
        rise = change[1]
        moves = nodes(scene, state.x - x)[:, 0]
        least, most = least - change[0] * moves.min(), most - change[0] * moves.max()
    gained = rows[0].friction - begun.friction
    assert 0.0 < least < gained < most
    assert abs(rows[0].residual - begun.residual) < 1e-6 * gained


@pytest.mark.parametrize("speed", [None, 10.0])
def test_a_step_that_fails_is_halved_and_the_stage_ends_on_time(speed):
    case = pressed(3, 0.3, 3, contact="none", speed=speed, solver=TIGHT | {"max_iterations": 6})
    result = simulate(case)
    history = result.history
    assert result.status == "converged"
    assert result.summary["steps"] > 3
    stroke = 0.3 * case.lattice.height
    np.testing.assert_allclose(
        history["top_displacement_m"], stroke * np.arange(4) / 3, rtol=0, atol=1e-15
    )
    np.testing.assert_allclose(np.diff(history["time_s"]), history["time_s"][-1] / 3, rtol=1e-12)
    if speed is not None:
        assert history["time_s"][-1] == pytest.approx(stroke / speed, rel=1e-12)
    assert unbalanced(history) < 1e-8


def test_a_step_that_outlasts_a_collapse_is_minimised_like_a_static_one():
    """In shorter shares, each of few shortened moves, the collapse would be followed in time."""
    case = Case.of(
        lattice=dict(cells_x=8, cells_y=8, wall_thickness=2e-4),
        loading=dict(force=10.0, release_time=1.0, duration=2.0),
        solver=dict(time_step=0.1),
    )
    whole = simulate(case)
    with patch("sweep.scene.loading.sqrt", return_value=np.inf):
        followed = simulate(case)
    assert whole.status == followed.status == "converged"
    assert whole.summary["steps"] == 20
    assert whole.summary["newton_iterations"] < 0.5 * followed.summary["newton_iterations"]
    assert unbalanced(whole.history) < 1e-9


@pytest.mark.parametrize("is_interrupted", [False, True])
def test_a_march_that_ends_early_keeps_what_is_done(is_interrupted):
    """After an interruption, and after a step that fails at any length."""
    case = pressed(3, 0.3, 10, contact="none")
    scene = build_scene(case)
    state, control = at_rest(scene), np.zeros(2, dtype=np.int64)
    travel = 0.1 * case.lattice.height
    outcome, rows = go_on(case, scene, state, ramp(scene, 4, travel=(0.0, travel)), control)
    assert (outcome, len(rows), list(control)) == (outcomes.CONVERGED, 4, [0, 4])

    def parts():
        """All arrays of the state but ``lagged``, which an attempted step changes."""
        return [*state[:2], *state.rates, *state.gradients, *state[5:]]

    kept, control[0] = [part.copy() for part in parts()], is_interrupted
    stage, few = ramp(scene, 4, travel=(travel, 0.0)), {} if is_interrupted else {"iterations": 0}
    outcome, rows = go_on(case, scene, state, stage, control, **few)
    expected = outcomes.INTERRUPTED if is_interrupted else outcomes.ITERATIONS
    assert (outcome, len(rows), list(control)) == (expected, 0, [is_interrupted, 4])
    for part, before in zip(parts(), kept, strict=True):
        np.testing.assert_array_equal(part, before)


@pytest.mark.parametrize("steps", [8, 400])
def test_buckling_is_seen_however_small_the_steps(steps):
    """A straight column at twice its critical strain: a factor is not kept for ever."""
    case = column()
    scene = build_scene(case)
    state, travel = at_rest(scene), BUCKLED * case.lattice.height
    outcome, rows = go_on(case, scene, state, ramp(scene, steps, travel=(0.0, travel)))
    assert outcome == outcomes.CONVERGED
    bent, stretched = rows[-1].bend, rows[-1].stretch
    assert bent > 0.5 * stretched
    before = rows[steps // 8].bend
    assert before < 1e-12 * bent
