"""Load and time stepping: marches through a stage in adaptive shares, and keeps the energy book.

A stage is divided into equal rows, and a step is a share of a row (`step_size`). Static steps of a
stated accuracy (`load_step_error`) grow beyond one row: the rows in between are left out of the
history. A large lattice that snaps takes many iterations in a static step, however short: each
failure of a share doubles the iterations that the next one may take. The same holds for a step of
backward Euler in which the load alone would move the structure by more than its size, so that
inertia hardly counts.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import add, copy, zero
from kernels.compile.jit import jit_exact, jit_owning
from kernels.compile.reference import by_reference
from kernels.solve import energy_book, integrators, load_step_error, resolution, step_size
from kernels.solve.energy_book import (
    energy_gain,
    enter_step,
    impose_speed,
    kinetic,
    mean_speed,
    unbalanced,
)
from kernels.solve.integrators import BACKWARD_EULER, BDF2, Ahead
from kernels.solve.newton import DESCENT, minimise
from kernels.solve.outcomes import (
    CONVERGED,
    INACCURATE,
    INTERRUPTED,
    ITERATIONS,
    OUTGROWN,
    STALLED,
    UNBALANCED,
    UNRESOLVED,
)
from kernels.solve.problem import Step
from kernels.solve.residual import loosened, patient
from kernels.solve.workspace import make_workspace

SMALLEST_SHARE = 2.0**-24  # share of a step
MAX_EXTRAPOLATION = 2.0  # longest extrapolation of the last move, as a multiple of it
MOST_DOUBLINGS = 4  # of the iterations of a share that is static or longer than `Stage.fall`
MOST_OF_ROW = 4 << MOST_DOUBLINGS  # times the iterations of a minimisation, in a static row: a row
# that needs more would go on in very short shares, and might snap into another shape
SHORTEST = 0.125  # share of a row: first step where steps may span rows, as it has no friction yet
REJECTED_ERROR = 4.0  # times the allowed error: a step that spans rows is accepted below it; where
# walls relax, below the allowed error, as one that buckles too early is not undone
LARGEST_GAIN = 2e-3  # energy that backward Euler may generate, as a share of the largest energy
LARGEST_ERROR = 5e-2  # the same for the trapezoidal rule of other steps, whose loss has either sign
UNCHECKED_SHARE = 2.0**-12  # shorter shares of a step may generate more energy: the sum over all
# steps is checked in sweep/simulation/simulate.py
NOT_STARTED = -1  # corrections of a share before `_begin_share`
PROGRESS = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            ("row", np.int64),  # completed rows
            ("done", np.float64),  # completed share of the next row
            ("share", np.float64),  # attempted step, in rows
            ("failed", np.int64),  # failed attempts since the last accepted share
            ("patience", np.int64),  # shares to accept after a failure before one is doubled
            ("wait", np.int64),  # shares still to accept before one is doubled
            ("cause", np.int64),  # of shares below 1: last failed outcome that was not `UNRESOLVED`
            ("row_iterations", np.int64),  # Newton iterations for the row
            ("share_iterations", np.int64),  # Newton iterations for the share
            ("minimum_iterations", np.int64),  # Newton iterations for the present minimum
            ("corrections", np.int64),  # of the lagged forces in the share
            ("h", np.float64),  # of the last attempted share, s
            ("move", np.float64),  # of the driven coordinate in the last share, m; 0: none yet
            ("slope", np.float64),  # of its reaction in the last share, N/m
        ],
    )
)


class Stage(NamedTuple):
    """Linear ramps of the load factor and of the driven coordinate (m) from ``*0`` to ``*1``.

    steps: number of rows. duration: of one row in s; static ones have one too, for rate-dependent
    materials. dynamic: whether there is inertia. scheme: time integrator. error: allowed local
    error of a step, m. accuracy: allowed error of the work in a static step, as a share of that
    work. fall: time in which the load alone would move the structure by its size, s. longest: rows
    that a step may span, with an accuracy. relaxes: whether walls relax, which adds to the error.
    """

    steps: int
    duration: float
    dynamic: bool
    factor0: float
    factor1: float
    driven0: float
    driven1: float
    scheme: int = BACKWARD_EULER
    error: float = np.inf
    accuracy: float = np.inf
    fall: float = np.inf
    longest: int = 1
    relaxes: bool = False


@jit_exact
def _stage_fraction(stage, progress):
    """Return the completed fraction of the stage at the end of the attempted share."""
    return (progress.row + progress.done + progress.share) / stage.steps


@jit_exact
def _target(stage, progress):
    """Return the target of the driven coordinate at the end of the attempted share, m."""
    return stage.driven0 + (stage.driven1 - stage.driven0) * _stage_fraction(stage, progress)


@jit_exact
def _step(stage, state, mass, workspace, progress):
    """Return the `Step` of the attempted share."""
    duration = stage.duration * progress.share
    factor = stage.factor0 + (stage.factor1 - stage.factor0) * _stage_fraction(stage, progress)
    theta = integrators.weight(progress.h, duration, stage.dynamic)
    return Step(
        workspace.x0,
        workspace.y,
        workspace.x_pred,
        progress.h,
        duration,
        stage.dynamic,
        factor,
        theta,
        max(progress.share, 1.0),
        mean_speed(state.v, mass) if stage.dynamic else 0.0,
    )


@jit_exact
def _extrapolation(u, driven, remaining):
    """Return the factor by which to extrapolate the last move ``u`` (n,), 0 for no extrapolation.

    It is the ratio of the ``remaining`` move of the driven coordinate to its last one.
    """
    if driven < 0 or not 0.0 < remaining * u[driven]:
        return 0.0
    if abs(remaining) > MAX_EXTRAPOLATION * abs(u[driven]):
        return 0.0
    return remaining / u[driven]


@jit_exact
def _first_guess(problem, stage, state, workspace, duration, h, remaining):
    """Fill y, x~ and the move ``work.dx`` from which the minimisation starts.

    The move leads to the extrapolated positions; after a snap in a static step it is zero.
    remaining: move of the driven coordinate, m.
    """
    u, work, coordinates = workspace.evaluation.u, workspace.work, problem.scene.coordinates
    factor, heavy = _extrapolation(u, coordinates.driven, remaining), coordinates.heavy
    if stage.dynamic:
        integrators.predict(state, duration, h, heavy, workspace.y, workspace.x_pred, work.dx)
    else:
        copy(state.x, workspace.y)
        if factor * problem.travel(u) > max(coordinates.cap, MAX_EXTRAPOLATION * abs(remaining)):
            factor = 0.0  # the last step was a snap
        for i in range(u.size):
            work.dx[i] = factor * u[i]
    if factor > 0.0:
        work.dx[coordinates.driven] = remaining


@jit_exact
def _foresee(problem, stage, x, work):
    """Fill ``work.trial`` with the positions at which forces are lagged in a step from ``x`` (n,);
    return 0, or a move (m) that the neighbour lists do not cover.

    In a static step these are the extrapolated positions, if that whole move is admissible: normal
    forces at the start of a step have an error of first order in its length.
    """
    copy(x, work.trial)
    if stage.dynamic:
        return 0.0
    far = problem.travel(work.dx)
    if not problem.covers(x, far):
        return far
    if problem.step_limit(x, work.dx, far) == 1.0:
        add(work.dx, work.trial)
    return 0.0


@jit_exact
def _lag(problem, y, state):
    """Lag the forces at ``y`` (n,), and keep it; return whether there are or were any."""
    copy(y, state.lagged)
    return problem.lag(y)


@jit_exact
def _begin_share(problem, tolerance, stage, state, workspace, descent, progress):
    """Begin the next share of a step; return whether the neighbour lists cover its first guess."""
    work, driven, last = workspace.work, problem.scene.coordinates.driven, state.totals[0].last
    begins = stage.scheme != BACKWARD_EULER and last == 0.0
    if begins:
        factor = stage.factor0 + (stage.factor1 - stage.factor0) * _stage_fraction(stage, progress)
        first = resolution.first_share(problem, tolerance, stage.duration, factor, state, work)
        progress.share = min(progress.share, first)
    duration, remaining = stage.duration * progress.share, 0.0
    if driven >= 0:
        remaining = _target(stage, progress) - state.x[driven]
    h = integrators.length(stage.scheme, duration, last)
    if stage.dynamic and h != progress.h:  # the Hessian depends on h
        descent.since_factor = np.inf
    progress.h = h
    copy(state.x, workspace.x0)
    if stage.dynamic and driven >= 0 and begins:
        impose_speed(state, problem, remaining / duration, work.direction)
    _first_guess(problem, stage, state, workspace, duration, h, remaining)
    ahead = duration - h if h < duration else 0.0
    last = last if stage.scheme == BDF2 else 0.0
    rates = Ahead(ahead, last, state.rates.position, work.dx)
    problem.begin(
        _step(stage, state, problem.scene.coordinates.mass, workspace, progress), rates, work.trial
    )
    descent.travel_bound = _foresee(problem, stage, state.x, work)
    if descent.travel_bound > 0.0:
        return False
    if _lag(problem, work.trial, state):  # the Hessian of friction changes
        descent.since_factor = np.inf
    progress.share_iterations, progress.minimum_iterations, descent.cut_moves = 0, 0, 0
    progress.corrections = 0
    return True


@jit_exact
def _equilibrate(
    state, problem, step, corrections, tolerance, workspace, descent, control, progress
):
    """Minimise; lag the forces again at the minimum and minimise once more, ``corrections`` times.

    Return the outcome.
    """
    x, descent.evaluated = state.x, False
    while True:
        outcome = minimise(x, problem, step, tolerance, workspace, descent, control)
        progress.row_iterations += descent.iterations
        progress.share_iterations += descent.iterations
        progress.minimum_iterations += max(descent.iterations, 1)
        if outcome != CONVERGED or progress.corrections == corrections:
            break
        if not _lag(problem, x, state):
            break
        problem.exchange(step, workspace.evaluation)
        zero(workspace.work.dx)
        descent.evaluated, descent.since_factor = True, np.inf
        progress.corrections, progress.minimum_iterations = progress.corrections + 1, 0
    unlisted = outcome == CONVERGED and not problem.covers_projection(x)
    if unlisted:
        outcome, progress.minimum_iterations = OUTGROWN, 0
    if unlisted or (outcome == OUTGROWN and step.dynamic):
        zero(workspace.work.dx)  # the present point is the better guess
    return outcome


@jit_exact
def _gains_energy(problem, stage, state, step, evaluation, share, noise):
    """Return whether the integrator generates too much energy in a ``share`` of a step.

    That is, `LARGEST_GAIN` or `LARGEST_ERROR` of the largest energy more than the integrator has
    lost so far, and more than this limit times the share of the stage that the step covers.
    """
    gain, largest = energy_gain(stage.scheme, problem, step, state, evaluation)
    limit = (LARGEST_GAIN if step.theta == 1.0 else LARGEST_ERROR) * largest + noise
    return gain - state.book[0].integrator > limit and gain > limit * share / stage.steps


@jit_exact
def _judge(problem, stage, state, step, tolerance, load, workspace, descent, progress):
    """Return the outcome of a share after its equilibrium is found, and the ratio of its local
    error to the allowed one.

    load: `resolution.largest_load` of the step.
    """
    evaluation, work, ratio, share = workspace.evaluation, workspace.work, 0.0, progress.share
    if stage.error < np.inf:
        ratio = integrators.error(state, step, problem.scene.coordinates.heavy) / stage.error
    accurate = ratio <= 1.0
    if stage.accuracy < np.inf and share >= 1.0:
        error = load_step_error.relative_error(
            problem, stage, state, evaluation, work, progress, workspace.amplitude_rate
        )
        ratio = error / stage.accuracy
        accurate = ratio <= (1.0 if stage.relaxes else REJECTED_ERROR) or share <= 1.0
    if accurate and share > UNCHECKED_SHARE:
        accurate = not _gains_energy(
            problem, stage, state, step, evaluation, share, tolerance.noise
        )
    if not accurate:
        return INACCURATE, ratio
    decrement = descent.decrement
    if not resolution.is_resolved(
        problem, step, tolerance, state, evaluation, work, load, decrement
    ):
        return UNRESOLVED, ratio
    if unbalanced(problem, step, tolerance, state, evaluation, work):
        return UNBALANCED, ratio
    return CONVERGED, ratio


@jit_exact
def _reject(outcome, ratio, problem, step, state, workspace, descent, progress):
    """Reject a share: restore the state at its start, and shorten it.

    ratio: its error / the allowed one.
    """
    copy(workspace.x0, state.x)
    problem.roll_back(step)
    zero(workspace.evaluation.u)
    progress.corrections, descent.since_factor = NOT_STARTED, np.inf
    if outcome != UNRESOLVED:
        progress.cause = outcome
    step_size.shorten(ratio, outcome == INACCURATE, progress)


@jit_exact
def _accept(problem, stage, step, state, workspace, load, descent, progress):
    """Accept a share: update rates, commit the material, enter the energy book, project.

    load: `resolution.largest_load` of the step.
    """
    evaluation, work, book, totals = (
        workspace.evaluation,
        workspace.work,
        state.book[0],
        state.totals[0],
    )
    if stage.dynamic:
        book.integrator += integrators.kinetic_loss(
            stage.scheme, state, step, problem.scene.coordinates, evaluation.u
        )
        integrators.update(stage.scheme, state, step, problem, evaluation.u)
        book.kinetic = kinetic(state.v, problem.scene.coordinates.mass)
        totals.last = step.duration
    if stage.accuracy < np.inf:
        load_step_error.keep(problem, state, evaluation, work, progress, workspace.amplitude_rate)
    problem.commit(state.x, step, evaluation)
    enter_step(problem, step, state, evaluation, work)
    totals.force = resolution.largest_force(problem.scene.coordinates, state, evaluation, load)
    if energy_book.project(problem, step, state, evaluation, work.trial):
        descent.since_factor = np.inf
    totals.steps += 1


@jit_exact
def _next_share(ratio, iterations, stage, descent, progress):
    """Complete a share, and choose the next one by `step_size.adapt`."""
    progress.corrections = NOT_STARTED
    if progress.share < 1.0:
        descent.since_factor = np.inf
    else:
        progress.cause = CONVERGED
    step_size.adapt(ratio, iterations, stage, progress)


@jit_exact
def _reported(outcome, progress):
    """Return the outcome with which a march ends: the outcome that made the shares so short."""
    if outcome == UNRESOLVED and progress.cause != CONVERGED:
        outcome = progress.cause
    return ITERATIONS if outcome == OUTGROWN else outcome


@jit_exact
def _end_row(problem, stage, state, out, control, evaluation, progress):
    """Write the last of the complete rows, and go on to the next one."""
    totals, rows = state.totals[0], int(progress.done)
    totals.iterations += progress.row_iterations
    totals.time += rows * stage.duration
    progress.row, progress.done, progress.row_iterations = progress.row + rows, 0.0, 0
    problem.write(out, progress.row - 1, state, evaluation)
    control[1] += rows


@jit_exact
def _run(problem, tolerance, stage, state, out, control, workspace, descent, progress):
    """Continue the stage at ``progress`` to its end, or until the neighbours must be renewed.

    Return (outcome, rows completed).
    """
    while progress.row < stage.steps:
        if not stage.dynamic and progress.row_iterations > MOST_OF_ROW * tolerance.iterations:
            return ITERATIONS, progress.row
        if progress.corrections == NOT_STARTED:
            if not problem.covers(state.x, 0.0):  # after a rejected share
                descent.travel_bound = 0.0
                return OUTGROWN, progress.row
            if not _begin_share(problem, tolerance, stage, state, workspace, descent, progress):
                return OUTGROWN, progress.row
        step = _step(stage, state, problem.scene.coordinates.mass, workspace, progress)
        descent.target = _target(stage, progress)
        load = resolution.largest_load(problem, step.factor, workspace.work)
        usual = loosened(tolerance, state.totals[0].force)
        fitting = resolution.fit(usual, step, problem.scene.coordinates, load)
        if not step.dynamic or step.h > stage.fall:
            fitting = patient(fitting, min(progress.failed, MOST_DOUBLINGS))
        outcome = _equilibrate(
            state, problem, step, integrators.corrections(stage.scheme), fitting, workspace,
            descent, control, progress,
        )  # fmt: skip
        if outcome == OUTGROWN and progress.minimum_iterations <= fitting.iterations:
            return outcome, progress.row
        ratio = 0.0
        if outcome == CONVERGED:
            outcome, ratio = _judge(
                problem, stage, state, step, fitting, load, workspace, descent, progress
            )
        elif resolution.is_tighter(fitting, usual) and outcome in (ITERATIONS, STALLED):
            outcome = UNRESOLVED
        if outcome == CONVERGED:
            _accept(problem, stage, step, state, workspace, load, descent, progress)
            _next_share(ratio, tolerance.iterations, stage, descent, progress)
            if progress.done >= 1.0:
                _end_row(problem, stage, state, out, control, workspace.evaluation, progress)
            elif stage.dynamic:
                problem.write_share(out, progress.row, state, workspace.evaluation)
            continue
        coarse = outcome == UNRESOLVED or outcome == UNBALANCED
        coarse = coarse and resolution.is_coarse(fitting, step, problem, load)
        outcome = UNRESOLVED if coarse else outcome
        _reject(outcome, ratio, problem, step, state, workspace, descent, progress)
        if outcome == INTERRUPTED or progress.share < SMALLEST_SHARE or coarse:
            return _reported(outcome, progress), progress.row
    return CONVERGED, progress.row


@jit_owning
def march(scene, tolerance, stage, state, out, control):
    """March through ``stage`` from ``state`` (changed in place); fill ``out``.

    Return (outcome, rows completed). scene: `problem.Scene`. control (2,): [0] != 0 interrupts, [1]
    counts completed rows.
    """
    progress, descent = np.zeros(1, PROGRESS), np.zeros(1, DESCENT)
    progress[0].share, progress[0].corrections, descent[0].since_factor = 1.0, NOT_STARTED, np.inf
    last = state.totals[0].last
    if stage.accuracy < np.inf:
        progress[0].share = SHORTEST
    elif stage.error < np.inf and last > 0.0:
        progress[0].share = last / stage.duration
    buffers = scene.make_buffers(state.memory)
    neighbours = scene.find_neighbours(state.x)
    workspace = make_workspace(state.x.size, state.stored.size)
    while True:
        problem = by_reference(scene).assemble(by_reference(neighbours), by_reference(buffers))
        outcome, rows = _run(
            problem, tolerance, stage, by_reference(state), out, control,
            by_reference(workspace), descent[0], progress[0],
        )  # fmt: skip
        if outcome != OUTGROWN:
            return outcome, rows
        # The factor outlives the pairs; where the matrix changes, `minimise` has discarded it.
        neighbours = scene.renew_neighbours(neighbours, state.x, descent[0].travel_bound)
