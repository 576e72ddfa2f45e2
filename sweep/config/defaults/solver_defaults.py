"""Completes the table `solver` of a case: load steps, time steps or arcs along a path."""

from math import ceil, hypot
from typing import TypeVar

from sweep.config.defaults.direction import height_pressed
from sweep.config.lattice_table import Lattice
from sweep.config.material_table import Material
from sweep.config.tables import MAX_STEPS, Loading, Solver, refusal

T = TypeVar("T")

ARCS = "arc_length"
STEPS_OF_PASSAGE = 1000  # time steps in which a free striker travels the lattice's height
IN_TIME = '"backward_euler", "bdf2" or "newmark"'  # the integrators


def check_bending(material: Material, solver: Solver) -> None:
    """Refuse statics without bending: there is no static equilibrium."""
    if material.bend == "none" and solver.integrator in ("static", ARCS):
        allowed = f'"linear", "section" or "fibres" if solver.integrator is "{solver.integrator}"'
        raise refusal("material.bend", "none", allowed)


def check_section(material: Material, solver: Solver) -> None:
    """Refuse a section whose curvature is not that of its fibres."""
    if material.through_fibres and solver.bend_measure != "angle":
        allowed = f'"angle" if material.bend is "{material.bend}"'
        raise refusal("solver.bend_measure", solver.bend_measure, allowed)


def with_joints(solver: Solver, material: Material, custom: bool) -> Solver:
    """The solver table with its joints: solid for cubic elements of a lattice."""
    solid = solver.element == "cubic" and material.bend != "none"
    if solver.joints == "solid" and not solid:
        why = (
            'material.bend is "none"'
            if solver.element == "cubic"
            else 'solver.element is "classical"'
        )
        raise refusal("solver.joints", "solid", f'"points" if {why}')
    joints = solver.joints or ("solid" if solid and not custom else "points")
    return solver.model_copy(update={"joints": joints})


def steps(loading: Loading, solver: Solver) -> float:
    """Number of steps of a resolved case."""
    if solver.load_steps is not None:
        moving = solver.load_steps * (2 if loading.unload else 1)
        return (moving + hold_steps(loading, solver)) * given_or(loading.cycles, 1)
    assert loading.duration is not None
    assert solver.time_step is not None
    return loading.duration / solver.time_step


def hold_steps(loading: Loading, solver: Solver) -> int:
    """Number of steps of a pause at full stroke: `load_steps`, or as long as those of a motion."""
    if loading.hold_time is None:
        return 0
    if solver.time_step is None:
        return given_or(solver.load_steps, 0)
    return _steps_in(loading.hold_time, solver.time_step)


def check_steps(solver: Solver, loading: Loading, time_step: float | None) -> None:
    """Refuse too many steps; `time_step` (s): the given one, if any."""
    count = steps(loading, solver)
    allowed = f"at most {MAX_STEPS:,} steps in all"
    if count > MAX_STEPS and solver.load_steps is not None and time_step is None:
        raise refusal("solver.load_steps", solver.load_steps, f"{allowed}, {count:,} here")
    if count > MAX_STEPS:
        raise refusal("solver.time_step", time_step or solver.time_step, allowed)


def settle(solver: Solver, loading: Loading, lattice: Lattice, by_position: bool) -> Solver:
    """The solver table with its steps and its integrator.

    A platen moves in `load_steps` equal steps, which set the time step of a crush in time. Along
    arcs, the default arc length is the diagonal of the structure / `load_steps`. The default of an
    impact is bdf2, whose error is a tenth of that of backward Euler with the same steps; with
    contact by position it is backward Euler.
    """
    if solver.step_error is not None and (loading.quasi_static or solver.integrator == ARCS):
        allowed = f"none unless solver.integrator is {IN_TIME}"
        raise refusal("solver.step_error", solver.step_error, allowed)
    if solver.integrator == ARCS:
        arcs = given_or(solver.load_steps, 200)
        usual = hypot(lattice.width, lattice.height) / arcs
        length = given_or(solver.arc_length, usual)
        step = {"time_step": None, "load_steps": arcs, "arc_length": length}
        return solver.model_copy(update=step)
    if loading.mode == "force" or (loading.mode == "custom" and not loading.quasi_static):
        step = {"time_step": given_or(solver.time_step, 1e-4), "load_steps": None}
    elif loading.striker_speed is not None:
        usual = height_pressed(lattice, loading) / loading.striker_speed / STEPS_OF_PASSAGE
        step = {"time_step": given_or(solver.time_step, usual), "load_steps": None}
    elif loading.quasi_static:
        step = {"time_step": None, "load_steps": given_or(solver.load_steps, 200)}
    else:
        assert loading.stroke is not None
        assert loading.speed is not None
        time = loading.stroke / loading.speed
        load_steps = given_or(solver.load_steps, _steps_in(time, solver.time_step))
        step = {"time_step": time / load_steps, "load_steps": load_steps}
    scheme = "bdf2" if loading.mode == "impact" and not by_position else "backward_euler"
    integrator = "static" if loading.quasi_static else solver.integrator or scheme
    return solver.model_copy(update={"integrator": integrator, "arc_length": None, **step})


def _steps_in(time: float, time_step: float | None) -> int:
    """Number of steps of at most ``time_step`` (s) in ``time`` (s); 200 if no step is given."""
    if time_step is None:
        return 200
    return ceil(min(time / time_step * (1 - 1e-9), MAX_STEPS + 1.0))


def given_or(value: T | None, default: T) -> T:
    """A value, or its default if it is None."""
    return default if value is None else value
