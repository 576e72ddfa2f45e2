"""The stages of a loading, and the tolerances of the solver."""

from math import ceil, inf, sqrt
from typing import NamedTuple, get_args

import numpy as np

from kernels.solve import integrators, march
from kernels.solve.residual import Tolerance
from sweep.config.case import Case
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.custom_loading import CustomLoading
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.directed import Ramp, Role
from sweep.config.kinds.solver import InTime, Static
from sweep.config.kinds.steps import rows_in_load_step
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.scene import Scene, time_step

IMPACT_STEPS = 64  # steps of a stage of an impact; after each stage the run may end
LONGEST = 4  # load steps that an accuracy-controlled step may span
UNLOADING = 3.0  # times the accuracy, while walls that relax are unloaded (docs/accuracy.md)
ROUND_OFF = 4e-15
LOADED = 100.0  # a residual in shares of the largest force / in shares of a wall's bending force
WHOLE = 1e-6  # share of a step: tolerance in the number of steps of a stage
SCHEMES = {
    "backward_euler": integrators.BACKWARD_EULER,
    "bdf2": integrators.BDF2,
    "newmark": integrators.TRAPEZOIDAL,
    "static": integrators.BACKWARD_EULER,  # without inertia
    "arc_length": integrators.BACKWARD_EULER,
}


ROLES: tuple[Role, ...] = get_args(Role)


class Phase(NamedTuple):
    """A stage, its name in messages, its role in the measurements, and its cycle."""

    name: str
    stage: march.Stage
    role: Role = "loading"
    cycle: int = 1


class CycleRows(NamedTuple):
    """Rows of a history at which a cycle begins, its loading ends, its unloading begins and ends.

    Rows that the run has not reached count too. Without unloading the last three are the same.
    """

    begun: int
    loaded: int
    released: int
    ended: int


def cycle_rows(phases: list[Phase]) -> list[CycleRows]:
    """The rows of every cycle; row 0 is the state before the first step."""
    cycles, done = list[CycleRows](), 0
    for number in range(1, phases[-1].cycle + 1):
        own = [phase for phase in phases if phase.cycle == number]
        loading, hold, unloading = (
            sum(phase.stage.steps for phase in own if phase.role == role) for role in ROLES
        )
        turned = done + loading
        cycles.append(CycleRows(done, turned, turned + hold, turned + hold + unloading))
        done = cycles[-1].ended
    return cycles


def stages(case: Case, scene: Scene | PlateScene) -> list[Phase]:
    """The stages of a case: linear ramps of loading and unloading, with the chosen integrator."""
    return [phase._replace(stage=_controlled(phase, case)) for phase in _stages(case, scene)]


def _controlled(phase: Phase, case: Case) -> march.Stage:
    """The stage of a phase with its integrator, and with the error allowed in a step.

    A pause has no accuracy, as nothing moves by which an error could be judged.
    """
    stage = phase.stage._replace(scheme=SCHEMES[case.solver.integrator])
    match case.solver:
        case InTime(step_error=float(error)):
            return stage._replace(error=error)
        case Static(accuracy=float(share)) if phase.role != "hold":
            rows, relaxes = rows_in_load_step(case.solver, case.material), case.material.relaxes
            eased = UNLOADING if relaxes and phase.role == "unloading" else 1.0
            return stage._replace(
                steps=rows * stage.steps,
                duration=stage.duration / rows,
                accuracy=eased * share,
                longest=LONGEST * rows,
                relaxes=relaxes,
            )
    return stage


def _stages(case: Case, scene: Scene | PlateScene) -> list[Phase]:
    loading, solver, longest = case.loading, case.solver, time_step(case)
    fall = inf
    if isinstance(loading, DeadLoad) and solver.integrator == "backward_euler":
        mass = float(scene.terms.coordinates.mass.sum()) / 2.0  # nodes have it in x and in y
        fall = sqrt(2.0 * mass * case.height / loading.force)  # the load moves it by the height
    start, travel = _course(case, scene)
    cycle = list[Phase]()
    for ramp in loading.ramps(solver):
        stage = _stage(ramp, longest, not loading.quasi_static, start, travel)._replace(fall=fall)
        parts = _parts(stage) if ramp.watched else [stage]
        cycle += [Phase(ramp.name, part, ramp.role) for part in parts]
    return _repeated(cycle, loading.cycles)


def _course(case: Case, scene: Scene | PlateScene) -> tuple[float, float]:
    """Start and travel of the driven coordinate, m."""
    match case.loading:
        case CustomLoading():
            return 0.0, scene.travel
        case Crush(stroke=stroke):
            return float(scene.x_rest[-1]), -stroke
    return float(scene.x_rest[-1]), 0.0


def _stage(ramp: Ramp, longest: float, dynamic: bool, start: float, travel: float) -> march.Stage:
    """The stage of a ramp, in equal steps of at most ``longest`` (s); start, travel: m."""
    steps, duration = ramp.steps, longest
    if ramp.time is not None:
        steps = steps or max(ceil(ramp.time / longest - WHOLE), 1)
        if ramp.steps or abs(steps * longest / ramp.time - 1.0) >= WHOLE:
            duration = ramp.time / steps
    factor0, factor1 = ramp.load
    driven0, driven1 = (start + share * travel for share in ramp.way)
    return march.Stage(steps or 1, duration, dynamic, factor0, factor1, driven0, driven1)


def _repeated(cycle: list[Phase], cycles: int) -> list[Phase]:
    """The phases of all cycles; from the second cycle on, their names include its number."""
    return [
        phase._replace(name=phase.name + (f" in cycle {n}" if n > 1 else ""), cycle=n)
        for n in range(1, cycles + 1)
        for phase in cycle
    ]


def _parts(stage: march.Stage) -> list[march.Stage]:
    """A stage, cut into stages after which the run may end."""
    starts = range(0, stage.steps, IMPACT_STEPS)
    return [stage._replace(steps=min(IMPACT_STEPS, stage.steps - done)) for done in starts]


def tolerances(case: Case, scene: Scene | PlateScene, stage: march.Stage) -> Tolerance:
    """Tolerances of forces and energies: ``solver.tolerance`` x scales, not below round-off.

    Where nothing moves they grow with the largest force so far, by `LOADED`; in a motion what is
    left over is momentum, which adds up from step to step.
    """
    force, size = _typical_force(scene), scene.size
    allowed = max(case.solver.tolerance * force, ROUND_OFF * scene.largest_force(stage))
    return Tolerance(
        force=allowed,
        decrement=1e-3 * allowed * case.lattice.wall_thickness,
        noise=ROUND_OFF * force * size,
        resolution=ROUND_OFF * size,
        iterations=case.solver.max_iterations,
        share=0.0 if stage.dynamic else LOADED * case.solver.tolerance,
    )


def round_off_decides(case: Case, scene: Scene | PlateScene, stage: march.Stage) -> bool:
    """Whether round-off sets the admissible residual, as steps are short or loads are small."""
    own = case.solver.tolerance * _typical_force(scene)
    return ROUND_OFF * scene.largest_force(stage) > own


def _typical_force(scene: Scene | PlateScene) -> float:
    """The greater of a force that bends a wall and the load, N."""
    coordinates = scene.terms.coordinates
    load = np.abs(coordinates.load * coordinates.lever).max(initial=0.0)
    return max(scene.force_scale, float(load))
