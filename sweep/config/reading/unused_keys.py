"""Keys without effect, and why: `grid` refuses a config with a key that none of its cases uses."""

from collections.abc import Mapping
from typing import Any

from sweep.config.case import Case
from sweep.config.defaults.direction import NOT_ACROSS, UNUSED, is_along
from sweep.config.defaults.solver_defaults import ARCS
from sweep.config.materials.material_file import locate, read_record
from sweep.config.structures.structure import Structure

PLASTICITY = ("material.hardening", "material.fracture_strain")
SOFTENING = ("material.softening_m", "material.softening_beta")
OF_STRUCTURES = (
    *("lattice.kind", "lattice.file", "lattice.wall_thickness"),
    *("lattice.nozzle", "lattice.printable"),
)
PRESSED_ALONG = ("lattice.imperfection", *(f"lattice.{key}" for key in NOT_ACROSS))
IDLE_ALONG = {f"{table}.{key}" for table, keys in UNUSED.items() for key in keys}
STEADY = "the stress of the material does not depend on time: it has neither loss nor relaxation"


def still_unused(unused: Mapping[str, str], given: Mapping[str, Any], case: Case) -> dict[str, str]:
    """The keys of `unused` that have no effect in this case either, each with the reason.

    given: the values from which the resolved `case` is made, by their dotted keys. A key that is
    not among them keeps the reason it has in `unused`.
    """
    reasons = {key: _clause(key, given, case) for key in unused if key in given}
    return {key: reasons.get(key, why) for key, why in unused.items() if reasons.get(key, "-")}


def _clause(key: str, given: Mapping[str, Any], case: Case) -> str:
    """A clause that says what has no effect, and why; empty if the key has its full effect."""
    if key == "lattice.file" and case.lattice.structure is not None:
        return _unused_part(case.lattice.structure, case)
    why = why_unused(key, given, case)
    return f"has no effect, as {why}" if why else ""


def _unused_part(structure: Structure, case: Case) -> str:
    """The part of a structure's file without effect in a static case; empty if there is none."""
    if not case.loading.quasi_static:
        return ""
    static = f'solver.integrator is "{case.solver.integrator}"'
    if any(map(any, structure.velocity_mm_s)):
        return f"its initial_velocity_mm_s has no effect, as {static}"
    if any(part.mass_g for part in structure.masses) and not any(structure.gravity_mm_s2):
        return f"masses in it have no effect, as {static} and there is no gravity"
    return ""


def why_unused(key: str, given: Mapping[str, Any], case: Case) -> str:
    """Why the given value of a key has no effect in a case; empty if it has an effect."""
    along = is_along(case.loading)
    if case.lattice.structure is not None and key.split(".")[0] == "lattice":
        effective = (*OF_STRUCTURES, *PRESSED_ALONG) if along else OF_STRUCTURES
        return "" if key in effective else 'lattice.kind is "custom"'
    if along and key in IDLE_ALONG:
        return f'loading.direction is "{case.loading.direction}"'
    table, name = key.split(".")
    resolved = getattr(getattr(case, table), name)
    if key == "material.reference_time" and not case.material.relaxes:
        return STEADY
    if key == "material.fibres" and case.material.fibres is None:
        return f'material.bend is "{case.material.bend}"'
    if key == "material.memory" and given[key] == "measured" and not _acts(given):
        return "the config itself gives what the file of the material states"
    if key in PLASTICITY and not case.material.yields:
        return "material.yield_stress is not given"
    if key in SOFTENING and case.material.softening_r is None:
        return "material.softening_r is not given"
    if key == "material.poisson" and case.material.plane == "stress":
        return 'material.plane is "stress"'
    used = resolved == given[key] or _used_otherwise(key, resolved, given, case)
    if used or table == "material":
        return ""
    return _reason_in_lattice(key, case) if table == "lattice" else _reason(key, given, case)


def _acts(given: Mapping[str, Any]) -> bool:
    """Whether a measured memory has a number that the config does not give."""
    stated = read_record(locate(given.get("material.name", "ninjaflex"))).memory
    others = {key for key in stated if given.get(f"material.{key}") is None}
    return bool(others - ({"loss"} if given.get("material.relaxation_times") else set()))


def _reason_in_lattice(key: str, case: Case) -> str:
    reasons = {
        "lattice.file": f'lattice.kind is "{case.lattice.kind}"',
        "lattice.orientation": f'lattice.kind is "{case.lattice.kind}"',
        "lattice.pattern": "lattice.slicer is not given",
        "lattice.fill_angle": "lattice.slicer is not given",
        "lattice.line_width": "there are neither lattice.perimeters nor a lattice.infill",
        "lattice.layer_height": "lattice.solid_layers is 0",
    }
    if key.removeprefix("lattice.") in NOT_ACROSS and not is_along(case.loading):
        return f'loading.direction is "{case.loading.direction}"'
    if key == "lattice.imperfection_seed":
        return "lattice.imperfection is 0"
    return reasons.get(key, "")


def _used_otherwise(key: str, resolved: object, given: Mapping[str, Any], case: Case) -> bool:
    """True if a value has an effect although the resolved case has another value, or None.

    A time step is adjusted to a whole number of steps; the speed of a quasi-static crush is a
    label; contact "auto" becomes the barrier.
    """
    if key == "contact.model":
        return given[key] == "auto"
    if key == "solver.time_step":
        return resolved is not None and "solver.load_steps" not in given
    return key == "loading.speed" and case.loading.mode == "displacement"


def _reason(key: str, given: Mapping[str, Any], case: Case) -> str:
    if ARCS in (key.split(".")[1], case.solver.integrator):
        return f'solver.integrator is "{case.solver.integrator}"'
    if case.lattice.structure is not None and key.startswith("loading."):
        return 'lattice.kind is "custom"'
    timed = ("loading.strain_rate", "loading.hold_time")
    if key in timed and case.loading.mode == "displacement":
        return STEADY
    stepped = key == "solver.load_steps" and case.loading.mode != "displacement"
    if key.startswith("loading.") or stepped:
        return f'loading.mode is "{case.loading.mode}"'
    if key.startswith("contact.") and case.contact.friction is None:
        return f'contact.model is "{case.contact.model}"'
    if case.loading.quasi_static:
        return "the crush is quasi-static"
    if key.startswith("damping.") and case.damping.model == "none" and "damping.model" not in given:
        return 'damping.model is "none" by default if the material relaxes; give a damping.model'
    if key.startswith("damping."):
        return f'damping.model is "{case.damping.model}"'
    return "contact.friction is 0" if key == "contact.slip_speed" else "solver.load_steps sets it"
