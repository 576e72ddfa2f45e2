"""Another problem through the same solver: a chain of particles, each in a double well."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize

from kernels.compile.kernel import Kernel
from kernels.solve import arc_length, history, march, newton, outcomes
from kernels.solve.integrators import TRAPEZOIDAL
from kernels.solve.problem import FREE, HELD, LED, Coordinates, Step
from kernels.solve.residual import Tolerance
from kernels.solve.workspace import make_workspace
from tests.support.kernels.chain import ROW, Line, Neighbours, Output

HEIGHT, WIDTH, SPRING, APART = 2.0, 1.5, 0.7, 0.4
TIGHT = Tolerance(1e-11, 1e-22, 1e-14, 4e-15, 100)


@pytest.fixture(autouse=True)
def plain_python(monkeypatch):
    """Kernels run as they are written: the chain has no compiled code."""
    monkeypatch.setattr(Kernel, "__call__", lambda kernel, *args: kernel.__wrapped__(*args))


def line(n, load=0.0, driven=False, held=False, friction=0.0, mass=1.0, spring=SPRING):
    """A chain of ``n`` particles; the last bears the load or is led, the first may be held."""
    role, one, forces = np.full(n, FREE), np.ones(n), np.zeros(n)
    forces[-1] = load
    role[0] = HELD if held else FREE
    role[-1] = LED if driven else role[-1]
    heavy = np.where(role == FREE, 1.0, 0.0)
    known = Coordinates(
        role, one, one, np.full(n, mass), heavy, forces, n - 1 if driven else -1, 0.5, 0.1, 1e-4
    )
    return Line(known, HEIGHT, WIDTH, spring, APART, friction, 1.0, 1e-4)


def energy(chain, x):
    """Stored energy at ``x``, computed independently."""
    wells = HEIGHT * np.sum(((x / WIDTH) ** 2 - 1.0) ** 2)
    return wells + 0.5 * chain.spring * np.sum((np.diff(x) - APART) ** 2)


def slope(x):
    """Force (N) with which a particle climbs at ``x``."""
    return 4.0 * HEIGHT * x / WIDTH**2 * ((x / WIDTH) ** 2 - 1.0)


def begun(chain, x):
    """State of rest at ``x``; the energy stored there counts as work done."""
    state = history.at_rest(np.asarray(x, dtype=float), 2)
    wells = HEIGHT * np.sum(((state.x / WIDTH) ** 2 - 1.0) ** 2)
    state.stored[:] = wells, energy(chain, state.x) - wells
    state.book[0].work = state.stored.sum()
    return state


def go(chain, state, stage, tolerance=TIGHT):
    """March; return the outcome, the rows and the positions."""
    out = Output(np.zeros(stage.steps, ROW), np.zeros((stage.steps, state.x.size)))
    control = np.zeros(2, np.int64)
    outcome, written = march.march(chain, tolerance, stage, state, out, control)
    return outcome, out.rows[:written], out.positions[:written]


def is_balanced(rows):
    """Whether the book of all rows closes."""
    size = max(np.abs(rows[name]).max() for name in ("work", "kinetic", "wells", "springs"))
    return np.abs(rows["residual"]).max() < 1e-9 * size


def test_it_leaves_the_top_of_the_hills():
    """All forces are zero there: the negative pivots tell, and where to go."""
    chain = line(4, spring=0.01)._replace(apart=0.0)
    state = begun(chain, np.zeros(4))
    outcome, _, (end,) = go(chain, state, march.Stage(1, 1.0, False, 1.0, 1.0, 0.0, 0.0))
    assert outcome == outcomes.CONVERGED
    np.testing.assert_allclose(np.abs(end), WIDTH, rtol=0.02)


def test_a_led_chain_goes_through_minima():
    """Each found by scipy from the step before, until a particle snaps over; the book closes."""
    chain = line(4, driven=True, held=True)
    start = minimize(lambda q: energy(chain, np.array([-1.5, *q, -1.2])), [-1.4, -1.3], tol=1e-12)
    state = begun(chain, [-1.5, *start.x, -1.2])
    stage = march.Stage(40, 1.0, False, 0.0, 0.0, -1.2, 4.8)
    outcome, rows, positions = go(chain, state, stage)
    assert outcome == outcomes.CONVERGED
    assert is_balanced(rows)
    assert np.abs(np.diff(positions[:, 1:3], axis=0)).max() > 0.5  # one snaps
    for x in positions:
        np.testing.assert_allclose([x[0], x[-1]], [-1.5, x[-1]], rtol=1e-15)
        found = minimize(
            lambda q, x=x: energy(chain, np.array([x[0], *q, x[-1]])), x[1:3], tol=1e-14
        )
        np.testing.assert_allclose(x[1:3], found.x, rtol=0, atol=1e-6)
    assert rows["integrator"][-1] > 1e-3  # the energy released by the snap
    np.testing.assert_allclose(positions[:, -1], np.linspace(-1.2, 4.8, 41)[1:], atol=1e-14)


def test_friction_of_a_loaded_particle_is_that_of_where_a_step_starts():
    """Load = dE/dx + mu n (1 + (x0 / a)^2) with x0 at the start, booked apart."""
    chain = line(1, load=1.8, friction=0.3)
    state = begun(chain, [-WIDTH])
    outcome, rows, positions = go(chain, state, march.Stage(8, 1.0, False, 0.0, 1.0, 0.0, 0.0))
    assert outcome == outcomes.CONVERGED
    assert is_balanced(rows)
    x = positions[:, 0]
    moves = np.diff(x, prepend=-WIDTH)
    sliding = moves > chain.slip
    assert sliding.sum() == 6  # 0.6 N of friction hold it at first
    rubbing = 0.3 * (1.0 + ((x - moves) / WIDTH) ** 2)
    load = 1.8 * np.arange(1, 9) / 8
    np.testing.assert_allclose((slope(x) + rubbing)[sliding], load[sliding], rtol=1e-8)
    paid = 0.5 * (rubbing[1:] + rubbing[:-1]) * moves[1:]  # trapezoids
    np.testing.assert_allclose(np.diff(rows["friction"])[3:], paid[3:], rtol=1e-8)


def test_friction_of_a_led_particle_is_that_of_where_it_is_led():
    """The extrapolated position is the final one, once there is a step as long as the next one."""
    chain = line(1, driven=True, friction=0.3)
    stage = march.Stage(8, 1.0, False, 0.0, 0.0, -WIDTH, -0.2 * WIDTH)
    outcome, rows, positions = go(chain, begun(chain, [-WIDTH]), stage)
    x = positions[2:, 0]
    assert outcome == outcomes.CONVERGED
    rubbing = 0.3 * (1.0 + (x / WIDTH) ** 2)
    np.testing.assert_allclose(rows["reaction"][2:], slope(x) + rubbing, rtol=1e-8)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_steps_are_as_long_as_their_accuracy_allows(friction):
    """The work up a smooth hill, compared with that in short steps."""
    chain, high, low = line(1, driven=True, friction=friction), -0.2, -1.0
    stage = march.Stage(200, 1.0, False, 0.0, 0.0, low * WIDTH, high * WIDTH, longest=4)
    _, short, _ = go(chain, begun(chain, [low * WIDTH]), stage._replace(accuracy=1e-9))
    errors, counts = [], []
    for accuracy in (3e-2, 3e-3, 3e-4):
        state = begun(chain, [low * WIDTH])
        outcome, rows, positions = go(chain, state, stage._replace(accuracy=accuracy))
        there = rows["time"] > 0.0  # the others were left out
        assert outcome == outcomes.CONVERGED
        assert is_balanced(rows[there])
        assert len(rows) == len(there) == rows["time"][-1] == 200
        travel = (positions[there, 0] / WIDTH - low) / (high - low)
        np.testing.assert_allclose(travel, rows["time"][there] / 200, rtol=1e-12)
        errors.append(abs(rows["work"][-1] / short["work"][-1] - 1.0) / accuracy)
        counts.append(there.sum())
    assert max(errors) < 1.0
    assert 50 < counts[0] < 60  # four rows a step
    assert counts[0] < counts[1] < counts[2] <= 200


@pytest.mark.parametrize(("scheme", "order"), [(march.BACKWARD_EULER, 1.0), (TRAPEZOIDAL, 2.0)])
def test_lagged_forces_keep_the_order_of_the_integrator(scheme, order):
    """With an integrator of order two they are corrected once. The particle slides down a slope."""
    chain, ends = line(1, load=6.0, friction=0.4)._replace(slip=1e-9), []
    for steps in (50, 100, 800):
        state = begun(chain, [-WIDTH])
        state.v[0] = 1.0
        stage = march.Stage(steps, 0.5 / steps, True, 1.0, 1.0, 0.0, 0.0, scheme)
        outcome, _, positions = go(chain, state, stage)
        assert outcome == outcomes.CONVERGED
        ends.append(positions[-1, 0])
    coarse, fine = abs(ends[0] - ends[2]), abs(ends[1] - ends[2])
    assert np.log2(coarse / fine) == pytest.approx(order, abs=0.15)


def test_an_arc_follows_the_slope_of_the_well():
    """One particle, pushed over the hill: load = dE/dx at every point, unstable where it falls."""
    chain = line(1, load=1.0, spring=0.0)
    top = brentq(lambda x: 3.0 * (x / WIDTH) ** 2 - 1.0, 0.0, WIDTH)
    hill = -slope(top)
    chain.coordinates.load[0] = 1.5 * hill
    steps = 200
    arc = arc_length.Arc(np.ones(1), 0.08, np.zeros(steps + 1, arc_length.POINT))
    out, state = Output(np.zeros(steps, ROW), np.zeros((steps, 1))), begun(chain, [-WIDTH])
    stage = march.Stage(steps, 1.0, False, 0.0, 1.0, 0.0, 0.0)
    loose = TIGHT._replace(force=1e-9, decrement=1e-18)
    outcome, written = arc_length.follow(chain, loose, stage, state, out, np.zeros(2, int), arc)
    assert outcome == outcomes.CONVERGED
    x, path = out.positions[:written, 0], arc.path[1 : written + 1]
    assert path["factor"][-1] == 1.0
    np.testing.assert_allclose(1.5 * hill * path["factor"], slope(x), rtol=0, atol=1e-8)
    np.testing.assert_array_equal(path["unstable"], np.abs(x) < top)
    assert path["factor"].min() == pytest.approx(-1.0 / 1.5, rel=0.01)
    assert np.any(path["unstable"])


def test_the_residual_is_not_measured_by_an_old_factor():
    """The last point of another step may have been very stiff: any force would be admissible."""
    chain = line(1, load=1.0)
    x0, zero = np.full(1, -WIDTH), np.zeros(1)
    problem = chain.assemble(Neighbours(x0), chain.make_buffers(np.empty((0, 0))))
    problem.buffers.hessian[:] = 1e20
    step = Step(x0, x0.copy(), x0.copy(), 1.0, 1.0, False, 1.0, 0.5, 1.0, 0.0)
    workspace, descent = make_workspace(1, 2), np.zeros(1, newton.DESCENT)[0]
    x, descent.since_factor, workspace.work.dx[:] = x0.copy(), np.inf, zero
    outcome = newton.minimise(x, problem, step, TIGHT, workspace, descent, np.zeros(2, int))
    assert outcome == outcomes.CONVERGED
    assert abs(workspace.evaluation.g[0]) < 1e-10
    assert x[0] > -WIDTH + 0.01
