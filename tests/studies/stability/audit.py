"""Simulate a scene under observation, and name whatever it violates.

The last step of every stage of loading is taken by itself, with what was before and after it kept:
the balance there is computed anew, with contact listed afresh and friction lagged where the march
did, and the stored energy of the walls is compared with `model`, unless the material has a memory:
then its dissipation must not fall. A structure that nothing holds has to move: one that stays at
rest has to bear its load there.

Time limits count processor time, so that other programs do not change which scenes end in time.
"""

import time
from types import SimpleNamespace
from typing import NamedTuple
from unittest.mock import patch

import numpy as np

from kernels.solve import arc_length, integrators, march, outcomes, residual
from kernels.solve.energy_book import mean_speed
from kernels.solve.problem import Step
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.simulation.custom_history import WITHOUT_PLATENS
from sweep.simulation.retries import simulate_again
from sweep.simulation.simulate import simulate
from tests.studies.stability.model import stored
from tests.support.designs.scenes import LOST, summed
from tests.support.designs.scenes import STORED as KEPT
from tests.support.kernels.solving import Whole, whole

MARCH, FOLLOW = march.march, arc_length.follow
CLOCK = SimpleNamespace(monotonic=time.process_time)  # of this process, which has one case
GRACE = 10.0  # s beyond its limit that a case may take
SAME = 1e-9  # of the largest force: two sums of the same forces
EARNED = 1e-6  # allowed error of an energy, as a share of the work done
LEFT = 1e-5  # energy that may be left over, as a share of the work done
REACH = 4.0  # times the reach of contact: pairs that may touch where friction is lagged
MADE = 5e-3  # energy that backward Euler may generate, as a share of the work done
STALE = 2.0  # residual over the allowed one, which goes with the stiffness of the last factor:
# where walls part since then, it is less at the end of the step
BORNE = 1e-3  # share of a load that may remain where nothing moves
SAID = (
    "the time integration gained energy",
    *(f"work and energies do not balance {where} " for where in ("at", "after")),
)


class Seen(NamedTuple):
    """One step: its scene, allowed residuals, itself, data of damping, and its end.

    lagged (n,): where friction was lagged last, m. whole: not divided into shares.
    """

    terms: object
    tolerance: object
    step: Step
    ahead: integrators.Ahead
    x: np.ndarray
    lagged: np.ndarray
    stored: np.ndarray
    whole: bool


class Watch:
    """Marches as `march` does, and keeps the last step of every stage.

    noise: energy in J that residuals may add up to, each along the size of the lattice. still:
    bodies that have not moved although their load was not borne.
    """

    def __init__(self):
        self.seen, self.still, self.noise = [], [], 0.0

    def __call__(self, terms, tolerance, stage, state, out, control):
        """March through a stage."""
        written = 0
        self.noise += stage.steps * tolerance.force * np.ptp(state.x[: 2 * terms.layout.n_nodes])
        for piece, rows in _pieces(stage):
            (step, ahead), steps = _next_step(terms, piece, state), state.totals[0].steps
            usual = residual.loosened(tolerance, state.totals[0].force)
            outcome, more = MARCH(terms, tolerance, piece, state, _part(out, rows), control)
            written += more
            if outcome != outcomes.CONVERGED:
                return outcome, written
            self.still += _unborne(terms, state, step)
        self._keep(terms, usual, step, ahead, state, state.totals[0].steps == steps + 1)
        return outcome, written

    def follow(self, terms, tolerance, stage, state, out, control, arc):
        """Follow a path; its last point is an equilibrium under its load."""
        x0 = state.x.copy()
        outcome, written = FOLLOW(terms, tolerance, stage, state, out, control, arc)
        if outcome == outcomes.CONVERGED:
            at = stage._replace(dynamic=False, factor1=state.totals[0].factor)
            step, ahead = _next_step(terms, at, state)
            self.still += _unborne(terms, state, step._replace(x0=x0))
            self._keep(terms, tolerance, step, ahead, state, True)
        return outcome, written

    def _keep(self, terms, tolerance, step, ahead, state, undivided):
        arrays = (array.copy() for array in (state.x, state.lagged, state.stored))
        self.seen.append(Seen(terms, tolerance, step, ahead, *arrays, undivided))


def _next_step(terms, stage, state):
    """The undivided step of a stage that comes next, and the data of its damping."""
    dt, last, x0 = stage.duration, state.totals[0].last, state.x.copy()
    y, x_pred, move = x0.copy(), x0.copy(), np.zeros_like(x0)
    rate = state.rates.position.copy()
    if not stage.dynamic:
        still = Step(x0, y, x_pred, 1.0, 1.0, False, stage.factor1, 0.5, 1.0, 0.0)
        return still, integrators.Ahead(0.0, 0.0, rate, move)
    h = integrators.length(stage.scheme, dt, last)
    integrators.predict(state, dt, h, terms.coordinates.heavy, y, x_pred, move)
    before = last if stage.scheme == integrators.BDF2 else 0.0
    ahead = integrators.Ahead(dt - h, before, rate, move)
    speed = mean_speed(state.v, terms.coordinates.mass)
    return Step(x0, y, x_pred, h, dt, True, stage.factor1, 0.5, 1.0, speed), ahead


def _unborne(terms, state, step):
    """A load that is not borne although nothing has moved in a step; 0 if there is none."""
    if not np.array_equal(state.x, step.x0) or state.v.any():
        return
    coordinates, left = terms.coordinates, np.zeros_like(state.x)
    here = whole(SimpleNamespace(terms=terms), state.x, factor=step.factor)
    here.problem.reduce(here.gradient(state.x), left)
    size = residual.largest_residual(left, coordinates)
    here.problem.reduce(step.factor * coordinates.load, left)
    load = residual.largest_residual(left, coordinates)
    if size > BORNE * load > 0.0:
        yield f"nothing moves under {load:.1e} N, of which {size:.1e} N are not borne"


def _pieces(stage):
    """All steps but the last, and the last; with their rows."""
    before = stage.steps - 1
    share = before / stage.steps
    driven = stage.driven0 + (stage.driven1 - stage.driven0) * share
    factor = stage.factor0 + (stage.factor1 - stage.factor0) * share
    if before > 0:
        yield stage._replace(steps=before, driven1=driven, factor1=factor), slice(0, before)
    last = stage._replace(steps=1, driven0=driven, factor0=factor, accuracy=np.inf)
    yield last, slice(before, None)


def _part(out, rows):
    return out._replace(rows=out.rows[rows], frame_of=out.frame_of[rows], probed=out.probed[rows])


class Audit(NamedTuple):
    """Status and message of a scene, its retry if it needs one, its violations, how many steps were
    balanced, its CPU time.
    """

    status: str
    message: str
    retry: str
    violations: tuple[str, ...]
    balanced: int
    cpu_s: float


def audit(case):
    """Simulate ``case`` as sweeps do, with its retries, and look for violations."""
    runs, started = [], time.process_time()

    def watched(case, stop, seconds):
        runs.append((Watch(), None))
        watch = runs[-1][0]
        with (
            patch("kernels.solve.march.march", watch),
            patch("kernels.solve.arc_length.follow", watch.follow),
        ):
            result = simulate(case, stop, seconds)
        runs[-1] = watch, result.history
        return result

    with (
        patch("sweep.simulation.retries.simulate", watched),
        patch("sweep.simulation.retries.time", CLOCK),
        patch("sweep.simulation.time_limit.time", CLOCK),
    ):
        result = simulate_again(case)
    seconds = time.process_time() - started
    watch = next(watch for watch, history in runs if history is result.history)
    found = [*watch.still[:1], *_numbers(result, case), *_shapes(result, case)]
    found += _energies(result, case, watch.noise)
    if seconds > case.solver.time_limit + GRACE:
        found.append(f"hung for {seconds:.0f} s")
    checked = [seen for seen in watch.seen if seen.whole]
    for seen in checked if not case.material.remembers else ():
        found += _balance(seen)
    retry, spent = result.summary["retry"], result.summary["cpu_s"]
    return Audit(str(result.status), result.message, retry, tuple(found), len(checked), spent)


def _numbers(result, case):
    blank = ("min_gap_m", "base_pressure_x_m")
    if isinstance(case.lattice, CustomStructure):
        blank += (*WITHOUT_PLATENS, "reaction_bottom_N", "base_pressure_Pa")
    for name, column in result.history.items():
        if name not in blank and not np.all(np.isfinite(column)):
            yield f"{name} is not finite"
    if not np.all(np.isfinite(result.frames["position_m"])):
        yield "positions are not finite"


def _shapes(result, case):
    """Walls that cross, and elements that turn over at their joint."""
    if result.summary["max_crossings"] > 0 and case.contact.model == "barrier":
        yield f"{result.summary['max_crossings']} crossings"
    made = result.message.startswith(SAID)  # of energy out of nothing, which linear walls follow
    if result.summary["least_element_strain"] <= -1.0 and not made:
        yield "an element without length"
    worst = max(_turned_over(shape, result.frames) for shape in result.frames["position_m"])
    if worst > 0:
        yield f"arms of {worst} joints have changed places"


def _turned_over(shape, frames):
    """Number of nodes whose arms are not in the order that they have at rest."""
    ends = np.concatenate([frames["edges"], frames["edges"][:, ::-1]])
    first, now = (_bearings(x, ends) for x in (frames["position_m"][0], shape))
    order = np.lexsort([first, ends[:, 0]])
    node, now = ends[order, 0], now[order]
    begun = np.searchsorted(node, node, side="left")
    count = np.searchsorted(node, node, side="right") - begun
    following = begun + (np.arange(len(node)) - begun + 1) % count
    opened = np.mod(now[following] - now, 2.0 * np.pi)
    turns = np.bincount(node, np.where(count > 1, opened, np.pi)) / (2.0 * np.pi)
    return int(np.sum(turns[np.bincount(node) > 1] > 1.5))


def _bearings(x, ends):
    vector = x[ends[:, 1]] - x[ends[:, 0]]
    return np.arctan2(vector[:, 1], vector[:, 0])


def _energies(result, case, noise):
    """Energy that nobody has brought in, unless the scene was stopped for that."""
    if result.message.startswith(SAID):
        return
    book = result.history
    paid = book["work_in_J"] + book["injected_by_projection_J"]
    held, lost = summed(book, KEPT), summed(book, LOST)
    size = max(np.abs(paid).max(), held.max(), np.abs(lost).max(), 1e-300)
    if np.abs(book["energy_residual_J"]).max() > LEFT * size + noise:
        yield f"{np.abs(book['energy_residual_J']).max() / size:.1e} of the energy is left over"
    given_back = np.max(-np.diff(book["dissipated_material_J"], prepend=0.0))
    if case.material.remembers and given_back > EARNED * size + noise:
        yield f"the material gives back {given_back / size:.1e} of what it has dissipated"
    if case.solver.integrator == "backward_euler" and (held - paid).max() > MADE * size + noise:
        yield f"{(held - paid).max() / size:.1e} of the energy out of nothing"


def _balance(seen):
    """The residual of a step and its energies, computed anew."""
    scene = SimpleNamespace(terms=seen.terms)
    h, points = seen.step.h if seen.step.dynamic else np.inf, 2 * seen.terms.layout.n_nodes
    moves = seen.x - seen.step.x0, seen.x - seen.lagged
    moved = max(np.linalg.norm(u[:points].reshape(-1, 2), axis=1).max() for u in moves)
    reach = REACH * seen.terms.contact.reach + 4.0 * moved
    made = whole(scene, seen.x, seen.step.x0, h, reach=reach)
    step = Whole(made.problem, seen.step)
    step.problem.begin(seen.step, seen.ahead, np.zeros_like(seen.x))
    step.problem.lag(seen.lagged)
    step.factor(seen.x)
    _, found = step.found(seen.x)
    left = np.zeros_like(seen.x)
    step.problem.reduce(found.g, left)
    size = residual.largest_residual(left, seen.terms.coordinates)
    allowed = residual.allowed(step.problem.stiffest(), seen.tolerance)
    if not size <= STALE * allowed:
        yield f"{size / allowed:.1e} of the allowed residual"
    second = stored(seen.x, seen.terms)
    error = np.abs(second.gradient - found.elastic).max()
    if not error <= SAME * second.scale + allowed:
        yield f"forces differ by {error / second.scale:.1e} from the second model"
    gap = np.abs(second.energy - seen.stored).max()
    if not gap <= SAME * second.energy.max() + allowed * np.ptp(seen.x):
        yield f"energies differ by {gap / second.energy.max():.1e} from the second model"
