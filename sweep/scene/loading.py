"""The stages of a loading, and the tolerances of the solver."""

from math import ceil, sqrt
from typing import Literal, NamedTuple, get_args

import numpy as np

from kernels.solve import integrators, march
from kernels.solve.residual import Tolerance
from sweep.config.case import Case
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.of_file import OfFile
from sweep.config.kinds.solver import InTime, Solver, Static
from sweep.config.kinds.steps import hold_steps
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.terms import Scene, time_step

IMPACT_STEPS = 64  # steps of a stage of an impact; after each stage the run may end
ROUND_OFF = 4e-15
WHOLE = 1e-6  # of a step: tolerance in the number of steps of a stage
SCHEMES = {
    "backward_euler": integrators.BACKWARD_EULER,
    "bdf2": integrators.BDF2,
    "newmark": integrators.TRAPEZOIDAL,
    "static": integrators.BACKWARD_EULER,  # without inertia
    "arc_length": integrators.BACKWARD_EULER,
}


Role = Literal["loading", "hold", "unloading"]  # in the order of a cycle
ROLES: tuple[Role, ...] = get_args(Role)


class Phase(NamedTuple):
    """A stage, its name in messages, what it is to the measures, and its cycle."""

    name: str
    stage: march.Stage
    role: Role = "loading"
    cycle: int = 1


class CycleRows(NamedTuple):
    """Rows of a history at which a cycle begins, its loading ends, its unloading begins and ends.

    Rows that the run has not reached count too. Without unloading the last three are one.
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
    return [phase._replace(stage=_controlled(phase, case.solver)) for phase in _stages(case, scene)]


def _controlled(phase: Phase, solver: Solver) -> march.Stage:
    """The stage of a phase with its integrator, and with the error that is allowed in a step.

    Nothing moves in a pause, by which an error could be judged.
    """
    stage = phase.stage._replace(scheme=SCHEMES[solver.integrator])
    match solver:
        case InTime(step_error=float(error)):
            return stage._replace(error=error)
        case Static(accuracy=float(share)) if phase.role != "hold":
            return stage._replace(accuracy=share)
    return stage


def _stages(case: Case, scene: Scene | PlateScene) -> list[Phase]:
    pace = time_step(case)
    match case.loading:
        case OfFile() as loading:
            return _stages_of_file(loading, case.solver, pace, scene.travel)
        case Crush() as loading:
            return _stages_of_crush(loading, case.solver, pace, float(scene.x_rest[-1]))
        case Impact(duration=duration):
            rest = float(scene.x_rest[-1])
            return _flight(_lasting(duration, pace, (1.0, 1.0), (rest, rest)))
        case DeadLoad() as loading:
            phases = _stages_of_load(loading, pace, float(scene.x_rest[-1]))
            if case.solver.integrator != "backward_euler":
                return phases
            fall = _time_of_fall(case, scene)
            return [phase._replace(stage=phase.stage._replace(fall=fall)) for phase in phases]


def _stages_of_file(loading: OfFile, solver: Solver, pace: float, travel: float) -> list[Phase]:
    """Loads and moves that act from the start, or that grow together in statics."""
    dynamic = not loading.quasi_static
    start = 1.0 if dynamic else 0.0
    if isinstance(solver, InTime):
        return [Phase("loading", _lasting(loading.duration, pace, (start, 1.0), (0.0, travel)))]
    stage = march.Stage(solver.load_steps, pace, dynamic, start, 1.0, 0.0, travel)
    return [Phase("loading", stage)]


def _stages_of_crush(loading: Crush, solver: Solver, pace: float, rest: float) -> list[Phase]:
    """Down from ``rest`` (m), a pause, and back up, for each cycle."""
    low, steps, dynamic = rest - loading.stroke, solver.load_steps or 1, not loading.quasi_static
    down = march.Stage(steps, pace, dynamic, 0.0, 0.0, rest, low)
    up = march.Stage(steps, pace, dynamic, 0.0, 0.0, low, rest)
    cycle, pause = [Phase("loading", down)], hold_steps(loading, solver)
    if loading.hold_time is not None:
        still = down._replace(steps=pause, duration=loading.hold_time / pause, driven0=low)
        cycle.append(Phase("holding", still, "hold"))
    if loading.unload:
        cycle.append(Phase("unloading", up, "unloading"))
    return _repeated(cycle, loading.cycles)


def _stages_of_load(loading: DeadLoad, pace: float, rest: float) -> list[Phase]:
    """A load that is on until its release."""
    still, release = (rest, rest), loading.release_time
    phases = [Phase("loading", _lasting(release, pace, (1.0, 1.0), still))]
    if release < loading.duration:
        released = _lasting(loading.duration - release, pace, (0.0, 0.0), still)
        phases.append(Phase("released", released, "unloading"))
    return phases


def _time_of_fall(case: Case, scene: Scene | PlateScene) -> float:
    """The time in which the load of a case would move its free masses by the height, s."""
    assert isinstance(case.loading, DeadLoad)
    mass = float(scene.terms.coordinates.mass.sum()) / 2.0  # that of a node counts along x and y
    return sqrt(2.0 * mass * case.height / case.loading.force)


def _repeated(cycle: list[Phase], cycles: int) -> list[Phase]:
    """The phases of all cycles; from the second on, their names say the cycle."""
    return [
        phase._replace(name=phase.name + (f" in cycle {n}" if n > 1 else ""), cycle=n)
        for n in range(1, cycles + 1)
        for phase in cycle
    ]


def _lasting(
    time: float, pace: float, factor: tuple[float, float], driven: tuple[float, float]
) -> march.Stage:
    """A stage of duration ``time`` (s) in equal steps, at most as long as ``pace`` (s)."""
    steps = max(ceil(time / pace - WHOLE), 1)
    duration = pace if abs(steps * pace / time - 1.0) < WHOLE else time / steps
    return march.Stage(steps, duration, True, *factor, *driven)


def _flight(flight: march.Stage) -> list[Phase]:
    """The motion of a striker, cut into stages after which the run may end."""
    starts = range(0, flight.steps, IMPACT_STEPS)
    parts = [min(IMPACT_STEPS, flight.steps - done) for done in starts]
    return [Phase("struck", flight._replace(steps=n)) for n in parts]


def tolerances(case: Case, scene: Scene | PlateScene, stage: march.Stage) -> Tolerance:
    """Tolerances of forces and energies: ``solver.tolerance`` x scales, not below round-off."""
    coordinates, size = scene.terms.coordinates, scene.size
    force = max(scene.force_scale, np.abs(coordinates.load * coordinates.lever).max(initial=0.0))
    allowed = max(case.solver.tolerance * force, ROUND_OFF * scene.largest_force(stage))
    return Tolerance(
        force=allowed,
        decrement=1e-3 * allowed * case.lattice.wall_thickness,
        noise=ROUND_OFF * force * size,
        resolution=ROUND_OFF * size,
        iterations=case.solver.max_iterations,
    )
