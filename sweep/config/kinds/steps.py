"""The steps of a case, and the solver that they imply."""

from typing import Any

from sweep.config.kinds.body import Body
from sweep.config.kinds.crush import Crush, steps_in
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.material import Material
from sweep.config.kinds.solver import (
    ARCS,
    IN_TIME,
    LOAD_STEPS,
    MAX_STEPS,
    Arcs,
    InTime,
    Solver,
    Static,
)
from sweep.config.kinds.table import Inputs, RefusedError, given_or, own_values

BY_ACCURACY = {"load_steps": 400, "accuracy": 1e-3}  # for a quasi-static crush without load_steps
BY_ACCURACY_ALONG = {"load_steps": 100, "accuracy": 1e-2}  # folds take paths that differ by more
ALONG = {"time_limit": 3600.0, "max_iterations": 300}  # where walls snap, 60 to 200 are common
ROWS_OF_RELAXING = 32  # of a load step: where walls that relax buckle, a step may be so short
IDLE_ALONG = ("element", "joints", "bend_measure", "hessian")


def solver(
    inputs: Inputs, material: Material, loading: Loading, body: Body, by_position: bool
) -> Solver:
    """The solver of these values, with its steps and its integrator.

    A platen moves in `load_steps` equal steps, which set the time step of a crush in time; a
    quasi-static one moves in steps of an `accuracy` unless they are given. Along arcs, the default
    arc length is the diagonal of the structure / `load_steps`. With contact by position the default
    integrator is backward Euler, else the `usual_motion` of the loading has it.
    """
    settings = dict(inputs)
    if material.remembers and inputs.get("integrator") == ARCS:  # its unstable part is no motion
        allowed = f'"static" or {IN_TIME} if the material has a memory'
        raise RefusedError("solver.integrator", ARCS, allowed)
    if body.shells:
        settings = ALONG | {key: value for key, value in inputs.items() if key not in IDLE_ALONG}
    if settings.get("integrator") == ARCS:
        usual = {"arc_length": body.diagonal / settings.get("load_steps", LOAD_STEPS)}
        solver: Solver = Arcs.model_validate(usual | own_values(settings, Arcs))
    else:
        solver = _steps(settings, loading, body, material.modulus, by_position)
    _check_count(solver, loading, material, inputs.get("time_step"))
    return solver


def _steps(
    settings: dict[str, Any], loading: Loading, body: Body, modulus: float, by_position: bool
) -> InTime | Static:
    if loading.quasi_static:
        by_accuracy = loading.driven and "load_steps" not in settings
        steps = BY_ACCURACY_ALONG if body.shells else BY_ACCURACY
        solver = (steps if by_accuracy else {}) | own_values(settings, Static)
        if "accuracy" in solver and not loading.driven:
            allowed = "none for loads of a file, which grow in equal load_steps"
            raise RefusedError("solver.accuracy", solver["accuracy"], allowed)
        return Static.model_validate(solver | {"integrator": "static"})
    given = own_values(({"integrator": "backward_euler"} if by_position else {}) | settings, InTime)
    timed = loading.usual_motion(given, body, modulus) | given
    if isinstance(loading, Crush):
        time = loading.stroke / given_or(loading.speed, 1.0)
        count = settings.get("load_steps", steps_in(time, settings.get("time_step")))
        return InTime.model_validate(timed | {"time_step": time / count, "load_steps": count})
    return InTime.model_validate(timed | {"load_steps": None})


def count_of(loading: Loading, solver: Solver) -> float:
    """Number of steps of a case."""
    return sum(ramp.steps_with(solver) for ramp in loading.ramps(solver)) * loading.cycles


def rows_in_load_step(solver: Solver, material: Material) -> int:
    """The rows of a load step: several where an accuracy-controlled step may be shorter."""
    by_accuracy = isinstance(solver, Static) and solver.accuracy is not None
    return ROWS_OF_RELAXING if by_accuracy and material.relaxes else 1


def _check_count(
    solver: Solver, loading: Loading, material: Material, time_step: float | None
) -> None:
    """Refuse too many steps; `time_step` (s): the given one, if any."""
    count, most = count_of(loading, solver), MAX_STEPS // rows_in_load_step(solver, material)
    allowed = f"at most {most:,} steps in all"
    if count <= most:
        return
    if solver.load_steps is not None and time_step is None:
        raise solver.refusal("load_steps", f"{allowed}, {count:,} here")
    step = solver.time_step if isinstance(solver, InTime) else None
    raise RefusedError("solver.time_step", given_or(time_step, step), allowed)


def in_the_plane(solver: Solver, material: Material, loading: Loading, shells: bool) -> Solver:
    """The solver of a lattice in the plane, with its joints; refuses values that its bending does
    not allow.

    Joints are solid for cubic elements of a lattice.
    """
    if shells:
        return solver
    if material.bend == "none" and not isinstance(solver, InTime):
        allowed = f'"linear", "section" or "fibres" if solver.integrator is "{solver.integrator}"'
        raise material.refusal("bend", allowed)
    if material.through_fibres and solver.bend_measure != "angle":
        raise solver.refusal("bend_measure", f'"angle" if material.bend is "{material.bend}"')
    solid = solver.element == "cubic" and material.bend != "none"
    if solver.joints == "solid" and not solid:
        cubic = solver.element == "cubic"
        why = 'material.bend is "none"' if cubic else 'solver.element is "classical"'
        raise solver.refusal("joints", f'"points" if {why}')
    usual = "solid" if solid and loading.solid else "points"
    return solver.model_copy(update={"joints": solver.joints or usual})
