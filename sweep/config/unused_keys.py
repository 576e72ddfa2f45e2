"""Keys that a case is given and does without: a sweep in which no case needs one is refused."""

from collections.abc import Mapping
from typing import Any

from sweep.config.case import Case
from sweep.config.solver_defaults import ARCS
from sweep.config.structure import Structure


def still_idle(idle: Mapping[str, str], given: Mapping[str, Any], case: Case) -> dict[str, str]:
    """The keys of `idle` that this case does without too, each with the reason where it is given.

    given : the values that the case, resolved, is made from, by their dotted keys.
    """
    reasons = {key: _clause(key, given, case) for key in idle if key in given}
    return {key: reasons.get(key, why) for key, why in idle.items() if reasons.get(key, "-")}


def _clause(key: str, given: Mapping[str, Any], case: Case) -> str:
    """What of a key has no effect, and why; empty if all of it has."""
    if key == "lattice.file" and case.lattice.structure is not None:
        return _idle_part(case.lattice.structure, case)
    why = why_idle(key, given, case)
    return f"has no effect, as {why}" if why else ""


def _idle_part(of: Structure, case: Case) -> str:
    """What of a structure's file only counts in motion."""
    if not case.loading.quasi_static:
        return ""
    static = f'solver.integrator is "{case.solver.integrator}"'
    if any(map(any, of.velocity_mm_s)):
        return f"its initial_velocity_mm_s has no effect, as {static}"
    if any(part.mass_g for part in of.masses) and not any(of.gravity_mm_s2):
        return f"masses in it have no effect, as {static} and there is no gravity"
    return ""


def why_idle(key: str, given: Mapping[str, Any], case: Case) -> str:
    """Why a case does without the value that it is given for a key; empty if it does not."""
    if case.lattice.structure is not None and key.split(".")[0] == "lattice":
        return "" if key in ("lattice.kind", "lattice.file") else 'lattice.kind is "custom"'
    table, name = key.split(".")
    held = getattr(getattr(case, table), name)
    if key == "material.poisson" and case.material.plane == "stress":
        return 'material.plane is "stress"'
    counts = held == given[key] or _counts_anyway(key, held, given, case)
    if counts or table == "material":
        return ""
    return _undrawn(key, case) if table == "lattice" else _reason(key, case)


def _undrawn(key: str, case: Case) -> str:
    reasons = {
        "lattice.file": f'lattice.kind is "{case.lattice.kind}"',
        "lattice.orientation": f'lattice.kind is "{case.lattice.kind}"',
        "lattice.line_width": "there are neither lattice.perimeters nor a lattice.infill",
        "lattice.layer_height": "lattice.solid_layers is 0",
    }
    return reasons.get(key, "")


def _counts_anyway(key: str, held: object, given: Mapping[str, Any], case: Case) -> bool:
    """True for values that count although the case holds another, or none.

    A time step is adjusted to a whole number of steps; the speed of a quasi-static crush is a
    label; contact that is "auto" is the barrier.
    """
    if key == "contact.model":
        return given[key] == "auto"
    if key == "solver.time_step":
        return held is not None and "solver.load_steps" not in given
    return key == "loading.speed" and case.loading.mode == "displacement"


def _reason(key: str, case: Case) -> str:
    if ARCS in (key.split(".")[1], case.solver.integrator):
        return f'solver.integrator is "{case.solver.integrator}"'
    if case.lattice.structure is not None and key.startswith("loading."):
        return 'lattice.kind is "custom"'
    timed = key == "solver.load_steps" and case.loading.mode != "displacement"
    if key.startswith("loading.") or timed:
        return f'loading.mode is "{case.loading.mode}"'
    if key.startswith("contact.") and case.contact.friction is None:
        return f'contact.model is "{case.contact.model}"'
    if case.loading.quasi_static:
        return "the crush is quasi-static"
    if key.startswith("damping."):
        return f'damping.model is "{case.damping.model}"'
    return "contact.friction is 0" if key == "contact.slip_speed" else "solver.load_steps sets it"
