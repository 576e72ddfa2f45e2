"""Completes the tables of a case: wall thickness for a mass, defaults that depend on the mode.

Keys that the mode does not use become None, so that equal physics has an equal id. Values that
contradict one another are refused. Resolving a resolved case changes nothing.
"""

from collections.abc import Mapping
from functools import lru_cache
from math import isclose, sqrt
from typing import Any, Literal

from pydantic_core import PydanticCustomError

from sweep.config.defaults.direction import check_platen, height_pressed, is_along, turned
from sweep.config.defaults.drop_tests import Drop, drop_of
from sweep.config.defaults.elements import with_elements
from sweep.config.defaults.printable import check_printable
from sweep.config.defaults.solver_defaults import (
    ARCS,
    IN_TIME,
    check_bending,
    check_section,
    check_steps,
    given_or,
    settle,
    with_joints,
)
from sweep.config.lattice_table import Lattice, sized
from sweep.config.structures.structure import Structure
from sweep.config.tables import Contact, Damping, Loading, Solver, refusal
from sweep.constants import STANDARD_GRAVITY

STRAIN_RATE = 0.01  # 1/s, of a quasi-static crush of a material that relaxes
FILTER_CLASS: Literal[1000] = 1000  # of SAE J211-1, as of a head form in drop tests (ASTM F1292)
PASSAGES = 10  # default duration of an impact / time the striker takes for the lattice's height
PLATENS = '"contact", "glued" or "sliding"'
DEPENDENT = ("loading", "contact", "damping", "solver")


def resolve(
    tables: Mapping[str, Any], sound: bool = True
) -> tuple[dict[str, Any], PydanticCustomError | None]:
    """The completed tables of a case by name, and the refusal if values contradict one another.

    Values that were completed before the refusal are kept, since an [[exclude]] may name them.
    sound: False if the lattice itself is refused; then no thickness is computed for its mass.
    """
    found = dict(tables)
    try:
        if sound:
            found["lattice"] = sized(found["lattice"], found["material"].density)
            check_printable(found["lattice"])
        found |= turned(found, sound)
        if sound and not is_along(found["loading"]):
            found["lattice"] = with_elements(found["lattice"])
        material = found["material"]
        settled = _settled(
            (material.relaxes, material.remembers),
            *(found[name] for name in ("lattice", *DEPENDENT)),
        )
        found |= zip(DEPENDENT, settled, strict=True)
        if is_along(found["loading"]):
            return found, None
        check_bending(found["material"], found["solver"])
        check_section(found["material"], found["solver"])
        custom = found["lattice"].structure is not None
        found["solver"] = with_joints(found["solver"], found["material"], custom)
    except PydanticCustomError as refused:
        return found, refused
    return found, None


@lru_cache(maxsize=4096)  # cases of a sweep share most of their tables
def _settled(
    memory: tuple[bool, bool],
    lattice: Lattice,
    loading: Loading,
    contact: Contact,
    damping: Damping,
    solver: Solver,
) -> tuple[Loading, Contact, Damping, Solver]:
    """The tables that depend on one another and on the lattice, completed; ``memory``: whether the
    stress of the material depends on time, and on the past.
    """
    relaxes, remembers = memory
    loading, wish = _loading(loading, lattice, solver.integrator), solver.time_step
    if remembers and solver.integrator == ARCS:
        allowed = f'"static" or {IN_TIME} if the material has a memory'
        raise refusal("solver.integrator", ARCS, allowed)
    height = height_pressed(lattice, loading)
    loading = _paced(loading, relaxes, height)
    solver = settle(solver, loading, lattice, contact.model == "position_based")
    check_steps(solver, loading, wish)
    contact = _contact(contact, loading, lattice.structure, solver)
    if contact.model == "position_based" and solver.integrator != "backward_euler":
        allowed = '"backward_euler" if contact.model is "position_based"'
        raise refusal("solver.integrator", solver.integrator, allowed)
    return loading, contact, _damping(damping, loading, relaxes), solver


def _loading(loading: Loading, lattice: Lattice, integrator: str | None) -> Loading:
    along = is_along(loading)
    if lattice.structure is not None and not along:
        return _of_structure(loading, lattice.structure, integrator)
    if loading.mode == "custom":
        allowed = '"force", "displacement" or "impact" unless lattice.kind is "custom"'
        raise refusal("loading.mode", "custom", allowed)
    if integrator == ARCS:
        unless = "" if along else ', unless lattice.kind is "custom"'
        allowed = f'"static" where quasi-static, else {IN_TIME}{unless}'
        raise refusal("solver.integrator", ARCS, allowed)
    if lattice.boundary == "periodic":
        return _mean(loading, lattice.height, integrator)
    check_platen(loading)
    height = height_pressed(lattice, loading)
    if loading.mode == "force":
        return _force(loading, integrator)
    if loading.mode == "impact":
        return _impact(loading, height, integrator)
    return _displacement(loading, height, integrator)


def _of_structure(loading: Loading, structure: Structure, integrator: str | None) -> Loading:
    """The loading in the file of a structure: for a duration, or quasi-static in equal steps."""
    quasi_static = integrator in ("static", ARCS) or bool(loading.quasi_static)
    if quasi_static and integrator not in (None, "static", ARCS):
        raise refusal("solver.integrator", integrator, '"static" if quasi_static')
    if quasi_static and structure.floor_y_mm is None:
        from sweep.config.structures.mechanism import find_mechanism

        found = find_mechanism(structure)
        if found:
            allowed = f"{IN_TIME}, or more supports: {found}"
            since = "loading.quasi_static"
            raise refusal("solver.integrator", integrator or "static", allowed, since)
    if integrator == ARCS and structure.prescribed:
        allowed = '"static", or loads instead of prescribed moves'
        raise refusal("solver.integrator", ARCS, allowed)
    if integrator == ARCS and not (structure.loads or any(structure.gravity_mm_s2)):
        raise refusal("solver.integrator", ARCS, '"static" where there are no loads')
    duration = given_or(loading.duration, 1.0 if quasi_static else 0.2)
    return Loading(mode="custom", duration=duration, quasi_static=quasi_static, platen="none")


def _force(loading: Loading, integrator: str | None) -> Loading:
    """A dead load, applied at once and removed at `release_time`; the run ends at `duration`."""
    if integrator == "static":
        raise refusal("solver.integrator", "static", f'{IN_TIME} if loading.mode is "force"')
    duration = given_or(loading.duration, 0.2)
    release_time = given_or(loading.release_time, min(0.138, duration))
    if release_time > duration:
        raise refusal("loading.release_time", release_time, f"up to the duration, {duration:g} s")
    return Loading(
        mode="force",
        force=given_or(loading.force, 10.0),
        release_time=release_time,
        duration=duration,
        platen=loading.platen or "none",
        allowed_forces=loading.allowed_forces,
    )


def _impact(loading: Loading, height: float, integrator: str | None) -> Loading:
    """A striker that hits the lattice; the run ends when it is back, or at `duration`."""
    if integrator == "static":
        raise refusal("solver.integrator", "static", f'{IN_TIME} if loading.mode is "impact"')
    if loading.platen == "none":
        raise refusal("loading.platen", "none", f'{PLATENS} if loading.mode is "impact"')
    striker_mass, drop_height = _dropped(loading)
    speed, energy, drop_height = _at_touch(loading, striker_mass, drop_height)
    return Loading(
        direction=loading.direction,
        mode="impact",
        striker_mass=striker_mass,
        striker_speed=speed,
        energy=energy,
        drop_height=drop_height,
        preset=loading.preset,
        specimens=loading.specimens,
        filter_class=given_or(loading.filter_class, FILTER_CLASS),
        duration=given_or(loading.duration, PASSAGES * height / speed),
        platen=loading.platen or "glued",
        allowed_forces=loading.allowed_forces,
    )


def _dropped(loading: Loading) -> tuple[float, float | None]:
    """Mass of the striker and height of its fall, of the preset where it says them."""
    mass, height, count = loading.striker_mass, loading.drop_height, loading.specimens
    drop = drop_of(loading.preset) if loading.preset else Drop(None, height or 0.0)
    if count and drop.mass is None:
        raise refusal("loading.specimens", count, "none unless loading.preset has a mass")
    if loading.preset and drop.mass is None and mass is None:
        raise refusal("loading.striker_mass", None, "the mass that falls, as the preset has none")
    usual = given_or(mass, 0.05) if drop.mass is None else drop.mass / (count or 1)
    if not isclose(given_or(mass, usual), usual, rel_tol=1e-9):
        raise refusal("loading.striker_mass", mass, f"{usual:g} kg, as loading.preset is given")
    if not isclose(given_or(height, drop.height), drop.height, rel_tol=1e-9):
        allowed = f"{drop.height:g} m, as loading.preset is given"
        raise refusal("loading.drop_height", height, allowed)
    return usual, drop.height or None


def _at_touch(
    loading: Loading, mass: float, drop_height: float | None
) -> tuple[float, float, float]:
    """Speed and energy of a striker and the height of its fall, from one of them: v^2 = 2 g h.

    2 m/s if none is given.
    """
    speed = given_or(loading.striker_speed, 2.0)
    if loading.striker_speed is None and drop_height is not None:
        speed = sqrt(2.0 * STANDARD_GRAVITY * drop_height)
    elif loading.striker_speed is None and loading.energy is not None:
        speed = sqrt(2.0 * loading.energy / mass)
    energy, fall = 0.5 * mass * speed**2, speed**2 / (2.0 * STANDARD_GRAVITY)
    source = "drop height" if loading.striker_speed is None else "speed"
    for key, value, found, unit in (
        ("drop_height", drop_height, fall, "m"),
        ("energy", loading.energy, energy, "J"),
    ):
        if not isclose(given_or(value, found), found, rel_tol=1e-9):
            of = "preset" if key == "drop_height" and loading.drop_height is None else key
            allowed = f"{found:g} {unit} at the {source} given; give one of them"
            raise refusal(f"loading.{of}", getattr(loading, of), allowed)
    return speed, given_or(loading.energy, energy), given_or(drop_height, fall)


def _displacement(loading: Loading, height: float, integrator: str | None) -> Loading:
    """A platen that moves down by `stroke`, rests there for `hold_time`, and moves back up if
    `unload`; the whole `cycles` times.
    """
    if loading.platen == "none":
        allowed = f'{PLATENS} if loading.mode is "displacement"'
        raise refusal("loading.platen", "none", allowed)
    speed, rate = _speed(loading, height), loading.strain_rate
    timed = speed is not None and rate is None
    quasi_static = given_or(loading.quasi_static, not timed or integrator == "static")
    if rate is not None and not quasi_static:
        raise refusal("loading.strain_rate", rate, "a speed, if quasi_static is false")
    if not quasi_static and integrator == "static":
        raise refusal("solver.integrator", "static", f"{IN_TIME} if not quasi_static")
    if not quasi_static and speed is None:
        raise refusal("loading.speed", None, "a speed if quasi_static is false")
    stroke, strain = _stroke_and_strain(loading, height)
    unload, cycles = given_or(loading.unload, True), given_or(loading.cycles, 1)
    if cycles > 1 and not unload:
        raise refusal("loading.cycles", cycles, "1 if loading.unload is false")
    return Loading(
        direction=loading.direction,
        mode="displacement",
        stroke=stroke,
        strain=strain,
        speed=speed,
        strain_rate=rate,
        quasi_static=quasi_static,
        hold_time=loading.hold_time,
        unload=unload,
        cycles=cycles,
        platen=loading.platen or "glued",
        allowed_forces=loading.allowed_forces,
    )


def _speed(loading: Loading, height: float) -> float | None:
    """The speed of a platen, from the strain rate if that is given."""
    if loading.strain_rate is None:
        return loading.speed
    speed = loading.strain_rate * height
    if not isclose(given_or(loading.speed, speed), speed, rel_tol=1e-9):
        raise refusal("loading.strain_rate", loading.strain_rate, "one of speed and strain_rate")
    return speed


def _paced(loading: Loading, relaxes: bool, height: float) -> Loading:
    """A loading whose quasi-static crush takes time only if the stress of the material depends on
    it.
    """
    if not (loading.mode == "displacement" and loading.quasi_static):
        return loading
    if not relaxes:
        timeless = dict.fromkeys(("speed", "strain_rate", "hold_time"))
        return loading.model_copy(update=timeless)
    speed = given_or(loading.speed, STRAIN_RATE * height)
    rate = given_or(loading.strain_rate, speed / height)
    return loading.model_copy(update={"speed": speed, "strain_rate": rate})


def _mean(loading: Loading, height: float, integrator: str | None) -> Loading:
    """The loading of an endless lattice: a prescribed mean strain, quasi-static, without platens.

    The inertia of a mean motion depends on the point of reference, so that motion is refused.
    """
    endless = 'if lattice.boundary is "periodic"'
    if loading.mode != "displacement":
        allowed = f'"displacement" {endless}'
        raise refusal("loading.mode", loading.mode, allowed, loading.says_mode)
    if loading.platen not in (None, "none"):
        raise refusal("loading.platen", loading.platen, f'"none" {endless}')
    pressed = _displacement(loading.model_copy(update={"platen": None}), height, integrator)
    if not pressed.quasi_static:
        raise refusal("loading.quasi_static", False, f"true {endless}", "loading.speed")
    return pressed.model_copy(update={"platen": "none"})


def _stroke_and_strain(loading: Loading, height: float) -> tuple[float, float]:
    """Stroke and strain, one from the other; 60 % strain if neither is given."""
    if loading.stroke is None:
        strain = given_or(loading.strain, 0.6)
        return strain * height, strain
    stroke, strain = loading.stroke, given_or(loading.strain, loading.stroke / height)
    if stroke >= height:
        pressed = "depth" if is_along(loading) else "height"
        raise refusal("loading.stroke", stroke, f"below the {pressed} of the lattice, {height:g} m")
    if not isclose(stroke, strain * height, rel_tol=1e-9):
        allowed = f"{strain * height:g} m at the strain given; give one of them"
        raise refusal("loading.stroke", stroke, allowed)
    return stroke, strain


def _contact(
    contact: Contact, loading: Loading, structure: Structure | None, solver: Solver
) -> Contact:
    """Loose platens and a floor need the barrier even if the contact model is "none".

    Friction is zero along arcs, since the unstable parts of an equilibrium path are not a motion.
    """
    if contact.model == "position_based":
        return _by_position(contact, loading, structure)
    if contact.model == "auto":
        contact = contact.model_copy(update={"model": "barrier"})
    floor = structure is not None and structure.floor_y_mm is not None
    if contact.model == "none" and loading.platen != "contact" and not floor:
        return Contact(model="none", friction=None, stiffness=None)
    if solver.integrator == ARCS:
        return contact.model_copy(update={"friction": 0.0, "slip_speed": None})
    if loading.quasi_static or not contact.friction:
        return contact.model_copy(update={"slip_speed": None})
    reference = loading.speed or loading.striker_speed or 0.1
    return contact.model_copy(update={"slip_speed": given_or(contact.slip_speed, 0.01 * reference)})


def _by_position(contact: Contact, loading: Loading, structure: Structure | None) -> Contact:
    """Contact by position exerts no force, so it can neither carry a platen nor cause friction."""
    allowed = '"none" or "barrier" if '
    if loading.quasi_static:
        raise refusal("contact.model", contact.model, f"{allowed}loading.quasi_static")
    if loading.platen == "contact":
        raise refusal("contact.model", contact.model, f'{allowed}loading.platen is "contact"')
    if structure is not None:
        raise refusal("contact.model", contact.model, f'{allowed}lattice.kind is "custom"')
    return contact.model_copy(update={"friction": None, "stiffness": None, "slip_speed": None})


def _damping(damping: Damping, loading: Loading, relaxes: bool) -> Damping:
    """The damping model, without the keys of others; a quasi-static case has no damping, and a
    material that relaxes has none unless it is asked for.
    """
    unused = {
        "none": ("mass", "stiffness", "relaxation_time"),
        "rayleigh": ("relaxation_time",),
        "kelvin_voigt": ("mass", "stiffness"),
    }
    chosen = damping.model or ("none" if relaxes else "rayleigh")
    model = "none" if loading.quasi_static else chosen
    return damping.model_copy(update={"model": model, **dict.fromkeys(unused[model])})
