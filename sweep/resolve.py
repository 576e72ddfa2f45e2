"""What a case leaves open, filled in: defaults that depend on its mode.

Keys that the mode does not use become None, so that equal physics has an equal id; what cannot go
together is refused. Resolving what is resolved changes nothing.
"""

from math import ceil, isclose
from typing import TypeVar

from sweep.tables import Contact, Damping, Loading, Solver, Table, refusal

T = TypeVar("T")


def resolve(
    height: float, loading: Loading, contact: Contact, damping: Damping, solver: Solver
) -> dict[str, Table]:
    """The tables that depend on one another and on the height of the lattice, nothing left open."""
    loading = _loading(loading, height, solver.integrator)
    return {
        "loading": loading,
        "contact": _contact(contact, loading),
        "damping": _damping(damping, loading),
        "solver": _solver(solver, loading),
    }


def _loading(loading: Loading, height: float, integrator: str | None) -> Loading:
    if loading.mode == "force":
        return _force(loading, integrator)
    return _displacement(loading, height, integrator)


def _force(loading: Loading, integrator: str | None) -> Loading:
    """A dead load, put on at once, let go at `release_time`, watched until `duration`."""
    if integrator == "static":
        raise refusal("solver.integrator", "static", '"backward_euler" if loading.mode is "force"')
    duration = _given(loading.duration, 0.2)
    release_time = _given(loading.release_time, min(0.138, duration))
    if release_time > duration:
        raise refusal("loading.release_time", release_time, f"up to the duration, {duration:g} s")
    return Loading(
        mode="force",
        force=_given(loading.force, 10.0),
        release_time=release_time,
        duration=duration,
        platen=loading.platen or "none",
        allowed_forces=loading.allowed_forces,
    )


def _displacement(loading: Loading, height: float, integrator: str | None) -> Loading:
    """A platen that moves down by `stroke`, and back if `unload`."""
    if loading.platen == "none":
        allowed = '"contact" or "glued" if loading.mode is "displacement"'
        raise refusal("loading.platen", "none", allowed)
    quasi_static = _given(loading.quasi_static, loading.speed is None or integrator == "static")
    if not quasi_static and integrator == "static":
        raise refusal("solver.integrator", "static", '"backward_euler" if not quasi_static')
    if not quasi_static and loading.speed is None:
        raise refusal("loading.speed", None, "a speed if quasi_static is false")
    stroke, strain = _stroke_and_strain(loading, height)
    return Loading(
        mode="displacement",
        stroke=stroke,
        strain=strain,
        speed=None if quasi_static else loading.speed,
        quasi_static=quasi_static,
        unload=_given(loading.unload, True),
        platen=loading.platen or "glued",
        allowed_forces=loading.allowed_forces,
    )


def _stroke_and_strain(loading: Loading, height: float) -> tuple[float, float]:
    """Each from the other: 60 % strain if neither is given."""
    if loading.stroke is None:
        strain = _given(loading.strain, 0.6)
        return strain * height, strain
    stroke, strain = loading.stroke, _given(loading.strain, loading.stroke / height)
    if stroke >= height:
        raise refusal("loading.stroke", stroke, f"below the height of the lattice, {height:g} m")
    if not isclose(stroke, strain * height, rel_tol=1e-9):
        allowed = f"{strain * height:g} m at the strain given; give one of them"
        raise refusal("loading.stroke", stroke, allowed)
    return stroke, strain


def _contact(contact: Contact, loading: Loading) -> Contact:
    """A platen that is not glued needs the barrier even where walls do not see each other."""
    if contact.model == "none" and loading.platen != "contact":
        return Contact(model="none", friction=None, stiffness=None)
    if loading.quasi_static or not contact.friction:
        return contact.model_copy(update={"slip_speed": None})
    reference = 0.1 if loading.speed is None else loading.speed
    return contact.model_copy(update={"slip_speed": _given(contact.slip_speed, 0.01 * reference)})


def _damping(damping: Damping, loading: Loading) -> Damping:
    """Without time there is nothing to damp."""
    unused = {
        "none": ("mass", "stiffness", "relaxation_time"),
        "rayleigh": ("relaxation_time",),
        "kelvin_voigt": ("mass", "stiffness"),
    }
    model = "none" if loading.quasi_static else damping.model
    return damping.model_copy(update={"model": model, **dict.fromkeys(unused[model])})


def _solver(solver: Solver, loading: Loading) -> Solver:
    """A platen moves in `load_steps` equal steps, which set the time step if there is time."""
    if loading.mode == "force":
        step = {"time_step": _given(solver.time_step, 1e-4), "load_steps": None}
    elif loading.quasi_static:
        step = {"time_step": None, "load_steps": _given(solver.load_steps, 200)}
    else:
        assert loading.stroke is not None
        assert loading.speed is not None
        time = loading.stroke / loading.speed
        by_time = 200 if solver.time_step is None else ceil(time / solver.time_step * (1 - 1e-9))
        load_steps = _given(solver.load_steps, by_time)
        step = {"time_step": time / load_steps, "load_steps": load_steps}
    integrator = "static" if loading.quasi_static else "backward_euler"
    return solver.model_copy(update={"integrator": integrator, **step})


def _given(value: T | None, default: T) -> T:
    return default if value is None else value
