"""The steps of a case, and the solver that they imply."""

from math import ceil, pi, sqrt
from typing import Any, NamedTuple

from sweep.config.kinds.crush import Crush
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.material import Material
from sweep.config.kinds.of_file import OfFile
from sweep.config.kinds.solver import ARCS, IN_TIME, Arcs, InTime, Solver, Static
from sweep.config.kinds.table import Given, Pairs, RefusedError, chosen, given_or

# A million rows of history take 120 MB, and a million steps of one square cell half a minute.
MAX_STEPS = 1_000_000
LOAD_STEPS = 200
BY_ACCURACY = {"load_steps": 400, "accuracy": 1e-3}  # of a quasi-static crush without load_steps
BY_ACCURACY_ALONG = {"load_steps": 100, "accuracy": 1e-2}  # folds take paths that differ by more
TIME_STEP = 1e-4  # s
STEPS_OF_PASSAGE = 1000  # time steps in which a free striker travels the lattice's height
STEPS_OF_CONTACT = 20  # time steps in which a solid block would throw a striker back
ALONG = {"time_limit": 3600.0, "max_iterations": 300}  # where walls snap, 60 to 200 are common
IDLE_ALONG = ("element", "joints", "bend_measure", "hessian")


class Extent(NamedTuple):
    """What is pressed: its height and its diagonal in m, its compliance in m/N if solid, and
    whether its walls are shells in space.
    """

    height: float
    diagonal: float
    compliance: float
    shells: bool


def solver(
    values: Given | Pairs, remembers: bool, loading: Loading, extent: Extent, by_position: bool
) -> Solver:
    """The solver of these values, with its steps and its integrator.

    A platen moves in `load_steps` equal steps, which set the time step of a crush in time; a
    quasi-static one moves in steps of an `accuracy` unless they are given. Along arcs, the default
    arc length is the diagonal of the structure / `load_steps`. The default of
    an impact is bdf2, whose error is a tenth of that of backward Euler with the same steps; with
    contact by position it is backward Euler.
    """
    settings = given = dict(values)
    if remembers and given.get("integrator") == ARCS:  # its unstable part is no motion
        allowed = f'"static" or {IN_TIME} if the material has a memory'
        raise RefusedError("solver.integrator", ARCS, allowed)
    if extent.shells:
        settings = ALONG | {key: value for key, value in given.items() if key not in IDLE_ALONG}
    arcs = settings.get("integrator") == ARCS
    if "step_error" in settings and (loading.quasi_static or arcs):
        allowed = f"none unless solver.integrator is {IN_TIME}"
        raise RefusedError("solver.step_error", settings["step_error"], allowed)
    made = _arcs(settings, extent) if arcs else _steps(settings, loading, extent, by_position)
    _check_count(made, loading, given.get("time_step"))
    return made


def _arcs(settings: dict[str, Any], extent: Extent) -> Arcs:
    usual = extent.diagonal / settings.get("load_steps", LOAD_STEPS)
    return Arcs.model_validate({"arc_length": usual} | chosen(settings, Arcs))


def _steps(
    settings: dict[str, Any], loading: Loading, extent: Extent, by_position: bool
) -> InTime | Static:
    if loading.quasi_static:
        by_accuracy = isinstance(loading, Crush) and "load_steps" not in settings
        steps = BY_ACCURACY_ALONG if extent.shells else BY_ACCURACY
        made = (steps if by_accuracy else {}) | chosen(settings, Static)
        if "accuracy" in made and not isinstance(loading, Crush):
            allowed = "none for loads of a file, which grow in equal load_steps"
            raise RefusedError("solver.accuracy", made["accuracy"], allowed)
        return Static.model_validate(made | {"integrator": "static"})
    usual = "bdf2" if isinstance(loading, Impact) and not by_position else "backward_euler"
    timed = {"integrator": usual} | chosen(settings, InTime)
    if isinstance(loading, Crush):
        time = loading.stroke / given_or(loading.speed, 1.0)
        count = settings.get("load_steps", _steps_in(time, settings.get("time_step")))
        return InTime.model_validate(timed | {"time_step": time / count, "load_steps": count})
    step = TIME_STEP
    if isinstance(loading, Impact):
        step = max(impact_step(loading, extent), loading.duration / MAX_STEPS)
    return InTime.model_validate({"time_step": step} | timed | {"load_steps": None})


def impact_step(loading: Impact, extent: Extent) -> float:
    """The usual time step of an impact, if it has no more than `MAX_STEPS`, s: a share of contact.

    A fast striker is stopped within the height of the lattice, in which its weight speeds it up. A
    slow one is thrown back as by a spring of compliance c, after pi sqrt(m c) whatever its speed,
    with the reduced mass m; for a solid block, this time is a lower bound.
    """
    passage = extent.height / loading.greatest_speed(extent.height) / STEPS_OF_PASSAGE
    contact = pi * sqrt(loading.reduced_mass * extent.compliance) / STEPS_OF_CONTACT
    return min(passage, contact)


def count_of(loading: Loading, solver: Solver) -> float:
    """Number of steps of a case."""
    if not isinstance(loading, Crush):
        if solver.load_steps is not None:
            return solver.load_steps
        assert isinstance(solver, InTime)
        return loading.duration / solver.time_step
    moving = given_or(solver.load_steps, 0) * (2 if loading.unload else 1)
    return (moving + hold_steps(loading, solver)) * loading.cycles


def hold_steps(loading: Crush, solver: Solver) -> int:
    """Number of steps of a pause at full stroke: `load_steps`, or as long as those of a motion."""
    if loading.hold_time is None:
        return 0
    if isinstance(solver, InTime):
        return _steps_in(loading.hold_time, solver.time_step)
    return solver.load_steps


def _steps_in(time: float, time_step: float | None) -> int:
    """Number of steps of at most ``time_step`` (s) in ``time`` (s); 200 if no step is given."""
    if time_step is None:
        return LOAD_STEPS
    return ceil(min(time / time_step * (1 - 1e-9), MAX_STEPS + 1.0))


def _check_count(made: Solver, loading: Loading, time_step: float | None) -> None:
    """Refuse too many steps; `time_step` (s): the given one, if any."""
    count, allowed = count_of(loading, made), f"at most {MAX_STEPS:,} steps in all"
    if count <= MAX_STEPS:
        return
    if made.load_steps is not None and time_step is None:
        raise RefusedError("solver.load_steps", made.load_steps, f"{allowed}, {count:,} here")
    step = made.time_step if isinstance(made, InTime) else None
    raise RefusedError("solver.time_step", given_or(time_step, step), allowed)


def in_the_plane(made: Solver, material: Material, loading: Loading, shells: bool) -> Solver:
    """The solver of a lattice in the plane, with its joints; what its bending lacks is refused.

    Joints are solid for cubic elements of a lattice.
    """
    if shells:
        return made
    if material.bend == "none" and not isinstance(made, InTime):
        allowed = f'"linear", "section" or "fibres" if solver.integrator is "{made.integrator}"'
        raise RefusedError("material.bend", "none", allowed)
    if material.through_fibres and made.bend_measure != "angle":
        allowed = f'"angle" if material.bend is "{material.bend}"'
        raise RefusedError("solver.bend_measure", made.bend_measure, allowed)
    solid = made.element == "cubic" and material.bend != "none"
    if made.joints == "solid" and not solid:
        cubic = made.element == "cubic"
        why = 'material.bend is "none"' if cubic else 'solver.element is "classical"'
        raise RefusedError("solver.joints", "solid", f'"points" if {why}')
    usual = "solid" if solid and not isinstance(loading, OfFile) else "points"
    return made.model_copy(update={"joints": made.joints or usual})
