"""Simulates a case: builds the arrays, marches through the stages, measures. No files."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from kernels.geometry.specimen_height import height
from kernels.shared.rows import ROW, STRETCH, Output
from kernels.solve import arc_length, energy_book, march, outcomes
from kernels.terms.profile import free_path
from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.custom_loading import CustomLoading
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.solver import Arcs
from sweep.config.load import case_of
from sweep.config.structures.structure import Structure
from sweep.numbers import to_si
from sweep.result import Result, Status, failed_result
from sweep.scene.arc_length import arc_of, path_columns
from sweep.scene.custom import build_structure
from sweep.scene.lattice import build_scene
from sweep.scene.loading import CycleRows, Phase, cycle_rows, round_off_decides, stages, tolerances
from sweep.scene.periodic import build_periodic
from sweep.scene.plates.law import UnstableMaterialError
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.plates.scene import build_scene as build_plates
from sweep.scene.profiles import outlines
from sweep.scene.scene import Scene, damp_of, striker_of
from sweep.scene.sides import build_tied
from sweep.simulation.base_load import patch_width
from sweep.simulation.custom_history import structure_columns
from sweep.simulation.failures import (
    ADVICE,
    MOVES_DOWN,
    PUSHED_BACK,
    SLIPPED_OFF,
    TIPPED_OVER,
    Failure,
    break_message,
    broke,
    energy_gained,
    energy_unresolved,
    momentum_unresolved,
    passed_lattice,
    stopped,
    stopped_as,
    timed_out,
)
from sweep.simulation.plate_shapes import plate_frames, plate_strains
from sweep.simulation.shape_checks import strains_of
from sweep.simulation.striker import Curves, closing_speed, rests, second_stop, spent
from sweep.simulation.summary import (
    BOOK_COLUMNS,
    OF_THE_WHOLE_RUN,
    history_columns,
    peaks_of,
    summarise,
)
from sweep.simulation.time_limit import WATCH
from sweep.simulation.time_resolution import (
    MOST_LOST,
    OF_STRIKER,
    momentum_share,
    striker_share,
)

FRAMES = 40
EARLY_FRAMES = 4 * FRAMES  # most impacts and many paths end within a quarter of their steps
FEW_FRAMES = 8  # even frames of a run that ends soon
GAP = 1e-3  # allowed residual, as a share of the greatest energy in the book
CURABLE = {  # other steps or another imperfection may help
    *(outcomes.ITERATIONS, outcomes.STALLED, outcomes.SINGULAR, outcomes.INACCURATE),
    *(outcomes.UNBALANCED, outcomes.NOT_FINITE),
}
EXPIRED = 2  # value of `stop[0]` after the time limit
LOST, REGAINED = 0.1, 0.25  # share of the greatest force: a lattice slips away from a striker
UNTOUCHED = 1e-6  # share of the typical force: a striker touches nothing
UNSTRAINED = 1e-6  # share of the work done: energy of walls that bear nothing
CREATED = 0.1  # energy that an integrator may create, as a share of the work done


def simulate(
    case: Case | Mapping[str, Any], stop: np.ndarray | None = None, seconds: float | None = None
) -> Result:
    """Simulate ``case`` and return its `Result`; a numerical failure is a status, not an exception.

    case: a `Case`, or the tables of a config, as `crumple.case` takes them; `ConfigError` reports
    their faults. stop: int64 (3,). Another thread sets stop[0] to 1 to interrupt, the time limit to
    `EXPIRED`; stop[1] counts steps, of stop[2] that are planned. seconds: time left of
    `solver.time_limit`; all of it if None.
    """
    case = case_of(case)
    started = time.thread_time()
    left = case.solver.time_limit if seconds is None else seconds
    try:
        result = _simulated(case, np.zeros(3, np.int64) if stop is None else stop, left)
    except UnstableMaterialError as error:
        return failed_result(case, Status.STOPPED, str(error))
    spent = time.thread_time() - started  # includes the time to free the memory of the run
    return replace(result, summary={**result.summary, "cpu_s": spent})


def _simulated(case: Case, stop: np.ndarray, seconds: float) -> Result:
    scene = _scene(case)
    run = _Run(scene, case, stop)
    status, message = run.complete(seconds)
    rows = run.whole_rows()
    curves = history_columns(rows, case)
    if run.blind and isinstance(scene, Scene):
        curves = structure_columns(curves, run.probed[: run.done], scene, case)
        curves |= path_columns(run.arc, run.done)
    frames, (_, shapes) = run.frames(), run.shapes()
    strains = (
        plate_strains(shapes, scene)
        if isinstance(scene, PlateScene)
        else strains_of(shapes, scene.terms)
    )
    summary = summarise(case, scene, curves, frames, strains, run.cycles, peaks_of(case, rows))
    bears = _keeps_lattice(case, curves, run.cycles, scene.force_scale)
    stands = not _tips_over(case, curves, run.cycles)
    if status == Status.CONVERGED:
        status, message = _of_impact(case, summary, curves, run.where())
    if status == Status.CONVERGED and not bears:
        status, message = Status.SLIPPED, SLIPPED_OFF
    if not stands:
        status, message = Status.SLIPPED, TIPPED_OVER
    if status == Status.CONVERGED and broke(summary, case):
        message = break_message(summary)
    unresolved = status == Status.UNRESOLVED or _removes_energy(case, summary, curves)
    counts = run.is_loaded() and not unresolved and bears and stands
    if status != Status.CONVERGED:
        summary |= dict.fromkeys(OF_THE_WHOLE_RUN, np.nan)
    summary |= {
        "case_id": case.case_id,
        "status": str(status),
        "message": message,
        "retry": "",
        "loaded": int(status == Status.CONVERGED or counts),
        "steps": int(run.state.totals["steps"][0]),
        "newton_iterations": int(run.state.totals["iterations"][0]),
    }
    curable = run.curable or status == Status.UNRESOLVED or not stands
    return Result(case, status, message, summary, curves, frames, curable)


def _of_impact(
    case: Case, summary: Mapping[str, Any], curves: Curves, where: str
) -> tuple[Status, str]:
    """Status and message of a finished impact: whether it is complete and its steps resolve it."""
    if not isinstance(case.loading, Impact):
        return Status.CONVERGED, ""
    if _removes_energy(case, summary, curves):
        return energy_unresolved(case, summary["integrator_share"])
    mass, alpha = to_si(summary["mass_g"], "g"), damp_of(case).alpha_m
    if (share := momentum_share(case.loading, curves, mass, alpha)) > MOST_LOST:
        return momentum_unresolved(case, share)
    travel, last = curves["top_displacement_m"], len(curves["time_s"]) - 1
    if travel.argmax() == last and not rests(curves):
        gone = travel[last] > case.height and not case.shells
        return passed_lattice(case, where) if gone else stopped_as(MOVES_DOWN, where)
    speed = closing_speed(curves)
    if travel[last] > 0.0 > speed[last] and speed.argmin() == last:
        return stopped_as(PUSHED_BACK, where)
    return Status.CONVERGED, ""


def _keeps_lattice(case: Case, curves: Curves, cycles: Sequence[CycleRows], typical: float) -> bool:
    """Whether a striker that is not flat, or a base of ribs, bears force until full stroke.

    Otherwise the lattice slips away: the force falls below `LOST` of its greatest value, and does
    not rise to `REGAINED` again. If they never touch, it is below `UNTOUCHED` of a ``typical``
    force (N).
    """
    if not isinstance(case.loading, Crush) or not case.loading.is_shaped:
        return True
    force = curves["reaction_top_N"][: cycles[0].loaded + 1]
    after = force[force.argmax() :]
    lost = after.min() < LOST * force.max() and after[-1] < REGAINED * force.max()
    return bool(force.max() > UNTOUCHED * typical and not lost)


def _tips_over(case: Case, curves: Curves, cycles: Sequence[CycleRows]) -> bool:
    """Whether walls between loose flat platens store nothing at full stroke.

    A tall lattice tips over as a rigid body. In a motion, damping may take the work.
    """
    loading = case.loading
    if not isinstance(loading, Crush) or loading.is_shaped or not loading.quasi_static:
        return False
    if loading.platen != "contact":
        return False
    full, stored = cycles[0].loaded, curves["stretch_J"] + curves["bend_J"]
    if len(stored) <= full:
        return False
    return bool(stored[full] < UNSTRAINED * curves["work_in_J"][: full + 1].max())


def _removes_energy(case: Case, summary: Mapping[str, Any], curves: Curves) -> bool:
    """Whether the integrator removes so much energy from an impact that its steps do not resolve
    it.
    """
    if not isinstance(case.loading, Impact):
        return False
    return bool(summary["integrator_share"] > MOST_LOST and striker_share(curves) > OF_STRIKER)


def _scene(case: Case) -> Scene | PlateScene:
    if case.shells:
        return build_plates(case)
    match case.lattice:
        case CustomStructure():
            return build_structure(case)
        case Cells(endless=True):
            return build_periodic(case)
        case Cells(tied_sides=True):
            return build_tied(case)
    return build_scene(case)


class _Run:
    """The run of one scene: its state, the rows and frames written so far, its time limit.

    blind: True for a custom structure in the plane, which has no strain of its own.
    """

    def __init__(self, scene: Scene | PlateScene, case: Case, control: np.ndarray):
        self.scene, self.case, self.control = scene, case, control
        self.blind = isinstance(case.loading, CustomLoading)
        self.stages = stages(case, scene)
        total = sum(s.stage.steps for s in self.stages)
        self.state = scene.at_rest()
        self.state.v[:] = scene.velocity
        self.rows = np.zeros(total + 1, ROW)
        self.probed = np.zeros((total + 1, 2, scene.probes.size))
        self.probed[0, 0] = scene.x_rest[scene.probes]
        self.standing = scene.standing.copy()  # sorted in place
        self._begin()
        self.struck = isinstance(case.loading, Impact)
        early = self.struck or isinstance(case.solver, Arcs)
        control[2] = 0 if early else control[1] + total  # they end before all steps are done
        count = EARLY_FRAMES if early else FRAMES * case.loading.cycles
        self.slot_of, kept = _frames(total + 1, count, early)
        self.even_from = self.slot_of[max(round(total / count), 1)]  # slot of the first even frame
        self.slots = np.full(total + 1, -1)  # of the rows that are kept
        self.slots[0] = 0
        self.positions = np.tile(scene.x_rest, (kept, 1))
        self.arc = None if isinstance(scene, PlateScene) else arc_of(scene, case)
        self.done = self.reached = 1  # rows that are kept, and their number before any were dropped
        self.planned = 1  # rows of the stages so far, including rows that steps leave out
        self.noise, self.expired, self.curable = 0.0, False, False

    def _begin(self) -> None:
        """Fill the first row: initial kinetic energy and the energy of springs count as work done.

        If the initial state is not in equilibrium, the first step releases energy like a snap.
        """
        state, scene, row, book = self.state, self.scene, self.rows[0], self.state.book[0]
        strained = scene.strained()
        state.stored[STRETCH] = strained
        book.kinetic = energy_book.kinetic(state.v, scene.terms.coordinates.mass)
        book.work = strained + book.kinetic
        row.work, row.kinetic, row.stretch = book.work, book.kinetic, strained
        row.speed = scene.velocity[scene.terms.contact.high]
        row.height = row.least_height = height(scene.x_rest, scene.top, scene.base)
        row.gap = row.patch_at = np.nan

    def complete(self, seconds: float) -> tuple[Status, str]:
        """March through all stages within ``seconds``; return the status and its message."""
        with WATCH.limit(seconds, self._expire):
            for number, phase in enumerate(self.stages):
                outcome = self._through(number)
                if outcome != outcomes.INTERRUPTED and self._creates_energy(self.done):
                    self.curable = True
                    return energy_gained(self.case)
                if outcome != outcomes.CONVERGED:
                    return self._failed(outcome, phase)
                if self.struck and (self._is_over() or self._has_passed()):
                    break
        if not self._balances(self.done):
            noisy = self._residual(self.done) <= self.done * self.noise
            if noisy or round_off_decides(self.case, self.scene, phase.stage):
                return self._failed(outcomes.UNRESOLVED, phase)
            self.curable = True
            return stopped_as(ADVICE[outcomes.UNBALANCED], self.where())
        return Status.CONVERGED, ""

    def is_loaded(self) -> bool:
        """True if the first cycle is loaded to its end, with energies that balance until then: the
        platen at full stroke, the load released, or the striker above its lowest place again.
        """
        rows = self.cycles[0].loaded + 1
        passed = self.done > rows if self.struck else self.done >= rows
        return passed and self._balances(rows) and not self._creates_energy(rows)

    def _creates_energy(self, count: int) -> bool:
        """True if in ``count`` rows the integrator creates more than `CREATED` of the work done.

        A static structure is not checked: a result in few steps is useful however much energy they
        create.
        """
        if self.case.loading.quasi_static and self.blind:
            return False
        rows = self.rows[:count]
        return bool(rows["integrator"].min() < -CREATED * rows["work"].max() - self.noise)

    def _balances(self, count: int) -> bool:
        """True if in ``count`` rows the residual of the energy book is below a share `GAP` of its
        greatest entry; round-off is no excuse.
        """
        rows = self.rows[:count]
        size = max(np.abs(rows[name]).max() for name in BOOK_COLUMNS.values() if name != "residual")
        return self._residual(count) <= GAP * size

    def _residual(self, count: int) -> float:
        """Greatest residual of the energy book in ``count`` rows, J."""
        return float(np.abs(self.rows["residual"][:count]).max())

    def _is_over(self) -> bool:
        """Whether the striker is back where it started, has stopped again under its weight, or has
        no energy left.

        Later rows are dropped.
        """
        rows = self.rows[: self.done]
        heights = rows["height"]
        back = np.flatnonzero(heights[1:] >= heights[0]) + 1
        weighs = striker_of(self.case.loading).weight > 0.0
        last = back[0] if len(back) else second_stop(heights) if weighs else spent(rows)
        self.done = self.done if last is None else int(last) + 1
        return last is not None

    def _has_passed(self) -> bool:
        """Whether a striker that is not flat is below the base, and no wall is in its way as far as
        it can fall until `duration`, so that it never touches the lattice again.
        """
        loading, touch = self.case.loading, self.scene.terms.contact
        if not isinstance(loading, Impact) or loading.striker == "flat":
            return False
        row = self.rows[self.done - 1]
        speed, left = -float(row.speed), loading.duration - float(row.time)
        if speed <= 0.0 or self._strain(row.height) <= 1.0:
            return False
        fall = speed * left + 0.5 * loading.weight / loading.striker_mass * left**2
        return bool(free_path(self.state.x, touch.profiles, touch.high, -1.0) > fall)

    @property
    def cycles(self) -> list[CycleRows]:
        """Rows at which every cycle is loaded and unloaded: until full stroke or release, or until
        a striker stops and until its last row.
        """
        if self.struck:
            stopped = int(np.argmin(self.rows["height"][: self.done]))
            return [CycleRows(0, stopped, stopped, self.done - 1)]
        return cycle_rows(self.stages)

    def _expire(self) -> None:
        self.expired = True
        self.control[0] = self.control[0] or EXPIRED

    def _through(self, number: int) -> int:
        """March through a stage; return the outcome. Rows that a step leaves out are removed."""
        phase = self.stages[number]
        stage, start = phase.stage, self.done
        span = slice(start, start + stage.steps)
        self.rows["time"][span] = np.nan  # stays NaN in rows that a step leaves out
        self.rows["least_height"][span], self.rows["most_force"][span] = np.inf, -np.inf
        slots = self.slot_of[self.planned : self.planned + stage.steps]
        out = Output(
            self.rows[span],
            slots,
            self.positions,
            self.scene.bottom,
            self.scene.top,
            self.scene.base,
            self.scene.probes,
            self.probed[span],
            self.standing,
            np.empty((self.standing.size, 3)),
            patch_width(self.case),
        )
        if not self.struck:
            self.state.totals[0].last = 0.0  # loads jump between stages: do not extrapolate
        tolerance = tolerances(self.case, self.scene, stage)
        self.noise = tolerance.noise
        arguments = self.scene.terms, tolerance, stage, self.state, out, self.control[:2]
        outcome, passed = (
            march.march(*arguments) if self.arc is None else arc_length.follow(*arguments, self.arc)
        )
        there = np.flatnonzero(~np.isnan(out.rows["time"][:passed]))
        self.done = self.reached = start + len(there)
        self.planned += passed
        self.rows[start : self.done] = out.rows[there]
        self.probed[start : self.done] = out.probed[there]
        self.slots[start : self.done] = slots[there]
        if outcome == outcomes.CONVERGED:
            self.stages[number] = phase._replace(stage=stage._replace(steps=len(there)))
        return outcome

    def _failed(self, outcome: int, phase: Phase) -> Failure:
        where = f"while {phase.name}, {self.where()}"
        if self.expired:
            return timed_out(self.case, where)
        unbalanced = outcome == outcomes.UNBALANCED
        if unbalanced and round_off_decides(self.case, self.scene, phase.stage):
            outcome = outcomes.UNRESOLVED
        self.curable = outcome in CURABLE
        return stopped(self.case, outcome, where, driven=self.scene.terms.coordinates.driven >= 0)

    def where(self) -> str:
        """Strain and number of steps so far, in words."""
        steps = f"after {self.done - 1} steps"
        if self.blind:
            return steps
        strain = self._strain(self.rows["height"][self.done - 1])
        return f"at strain {strain:.3g} {steps}"

    def _strain(self, height: Floats) -> Floats:
        """Strain if the top is ``height`` (m) above the base; NaN for a custom structure."""
        if self.blind:
            return np.full_like(height, np.nan)
        return (self.rows["height"][0] - height) / self.case.height

    def whole_rows(self) -> np.ndarray:
        """The rows so far, scaled to the whole lattice if one of several equal parts is
        computed.
        """
        rows = self.rows[: self.done].copy()
        if isinstance(self.scene, PlateScene):
            for name in (*BOOK_COLUMNS.values(), "reaction_top", "reaction_bottom", "most_force"):
                rows[name] *= self.scene.mesh.copies
        if not self.scene.standing.size:
            rows["patch_force"] = rows["patch_at"] = np.nan
        return rows

    def shapes(self) -> tuple[np.ndarray, np.ndarray]:
        """The rows with a stored shape, up to the last row, and their positions (f, n).

        The shapes before the first even one are of use only to runs that end soon after it.
        """
        slots = self.slots[: self.reached]
        last = np.flatnonzero(np.diff(slots, append=-1))  # a later row overwrites its slot
        last = last[last < self.done]
        even = (last == 0) | (slots[last] >= self.even_from)
        last = last[even] if even.sum() > FEW_FRAMES else last
        return self.rows[last], self.positions[slots[last]]

    def frames(self) -> dict[str, np.ndarray]:
        """Stored shapes, as in `Result.frames`."""
        rows, x = self.shapes()
        if isinstance(self.scene, PlateScene):
            return plate_frames(x, self._strain(rows["height"]), rows["time"], self.scene)
        n = len(self.scene.mesh.points)
        plates = x[:, -2:].copy()
        if self.case.loading.platen == "none":
            plates[:] = np.nan
        match self.case.lattice:
            case Cells(endless=True):
                plates[:, 0] = -np.inf
            case CustomStructure(structure=Structure(floor_y_mm=float())):
                plates[:, 0] = x[:, self.scene.terms.contact.low]
        return {
            "strain": self._strain(rows["height"]),
            "time_s": rows["time"],
            "position_m": x[:, : 2 * n].reshape(len(x), n, 2),
            "plate_y_m": plates,
            "edges": self.scene.mesh.edges,
            "edge_thickness_m": self.scene.mesh.thickness,
            **outlines(self.case, self.scene.network),
        }


def _frames(n_rows: int, frames: int, early: bool) -> tuple[np.ndarray, int]:
    """The slot of every row for about ``frames`` even frames, and their number; with ``early`` also
    frames before the first even one, at growing distances.

    The last of the rows with the same slot is kept.
    """
    even = np.linspace(0, n_rows - 1, min(frames + 1, n_rows))
    before = np.geomspace(1.0, max(even[-1] / frames, 1.0), FRAMES) if early else even
    kept = np.unique(np.concatenate([even, before]).round().astype(int))
    return np.searchsorted(kept, np.arange(n_rows)), len(kept)
