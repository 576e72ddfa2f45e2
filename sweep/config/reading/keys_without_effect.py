"""Keys without effect, and why: `grid` refuses a config with a key that none of its cases uses."""

from collections.abc import Mapping
from typing import Any, get_args

from sweep.config.case import Case
from sweep.config.keys import KINDS, one_of
from sweep.config.kinds import material as materials
from sweep.config.kinds import steps
from sweep.config.kinds.contact import Barrier
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.custom_loading import CustomLoading
from sweep.config.kinds.damping import NoDamping
from sweep.config.kinds.direction import ACROSS, ALONG
from sweep.config.kinds.solver import ARCS
from sweep.config.kinds.specimen import Specimen
from sweep.config.kinds.table import Table
from sweep.config.materials.material_file import locate, read_record
from sweep.config.structures.structure import Structure

STILL = "the crush is quasi-static"
SIDES = ("sides", "width")  # keys of sheets
DRIVEN = ("solver.load_steps", "solver.accuracy")
CHOICE = {
    "lattice": "kind",
    "loading": "mode",
    "contact": "model",
    "damping": "model",
    "solver": "integrator",
}
"""The key of a table that chooses a kind."""
IDLE_ALONG = (
    "loading.base_patch",
    *(f"material.{key}" for key in materials.IDLE_ALONG),
    *(f"solver.{key}" for key in steps.IDLE_ALONG),
)


def keys_without_effect(
    unused: Mapping[str, str], values: Mapping[str, Any], case: Case
) -> dict[str, str]:
    """The keys of `unused` that have no effect in this case either, each with the reason.

    values: the values from which the `case` is made, by their dotted keys. A key that is not among
    them keeps the reason it has in `unused`.
    """
    reasons = {key: _clause(key, values, case) for key in unused if key in values}
    return {key: reasons.get(key, why) for key, why in unused.items() if reasons.get(key, "-")}


def _clause(key: str, values: Mapping[str, Any], case: Case) -> str:
    """A clause that says which part of a value has no effect, and why; empty if all of it has."""
    if key == "lattice.file" and case.lattice.loaded:
        return _unused_part(case.lattice.loaded, case)
    why = why_unused(key, values, case)
    return f"has no effect, as {why}{_needed(key, why, case)}" if why else ""


def _needed(key: str, why: str, case: Case) -> str:
    """A clause that says which kinds of a table take a key; empty if the kind of the case does."""
    table, name = key.split(".")
    if why == STILL:
        moves = case.loading.driven and not case.lattice.endless
        return "; needed: a loading.speed" if moves else ""
    kinds = [kind for kind in KINDS[table] if name in kind.model_fields]
    if key in DRIVEN and not case.loading.driven:
        kinds, table = [Crush], "loading"
    own = getattr(case, table)
    shells = case.shells and table != "lattice" and why == _why_shells(case)
    if isinstance(own, (*kinds, CustomLoading)) or shells or (case.lattice.sheet and name in SIDES):
        return ""
    kinds = [kind for kind in kinds if name not in kind.derived]
    words = [word for kind in kinds for word in _words(table, kind)]
    slicer = [kind for kind in kinds if table == "lattice" and "slicer" in kind.model_fields]
    needed = [f"{table}.{CHOICE[table]} = {one_of(dict.fromkeys(words))}"] if words else []
    return f"; needed: {' or '.join([*needed, *(['a lattice.slicer'] if slicer else [])])}"


def _words(table: str, kind: type[Table]) -> tuple[str, ...]:
    """The values of the key of a table that choose a kind."""
    if issubclass(kind, Specimen):
        return kind.words
    words: tuple[str, ...] = get_args(kind.model_fields[CHOICE[table]].annotation)
    return words[:1] if kind is Barrier else words


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


def why_unused(key: str, values: Mapping[str, Any], case: Case) -> str:
    """Why the given value of a key has no effect in a case; empty if it has an effect."""
    table, name = key.split(".")
    case_value = getattr(getattr(case, table), name, None)
    if key == "material.memory":
        return _why_no_memory(values)
    if key == "material.poisson" and case.material.plane == "stress":
        return 'material.plane is "stress"'
    if key == "loading.base_patch" and (case.lattice.endless or case.lattice.tied_sides):
        return "the lattice repeats"
    if case.shells and key in IDLE_ALONG:
        return _why_shells(case)
    if case_value == values[key] or _used_otherwise(key, case_value, values, case):
        return ""
    implied = getattr(case, table).implies(name, values[key])
    return "" if implied else _reason(key, values, case)


def _used_otherwise(key: str, case_value: object, values: Mapping[str, Any], case: Case) -> bool:
    """True if a value has an effect although the case has another value, or none.

    A time step is adjusted to a whole number of steps; the speed of a quasi-static crush is a
    label; contact "auto" becomes the barrier, a "drop" an impact with gravity; the name of a file
    is stored without its folder; the share of a sheet, and the sides of a block, are the nearest
    that fit.
    """
    table, name = key.split(".")
    if name in (kind := getattr(case, table)).fits:
        return name in kind.inputs()
    if key == "contact.model":
        return bool(values[key] == "auto")
    if key == "loading.mode":
        return values[key] in case.loading.words
    if key == "solver.time_step":
        return case_value is not None and "solver.load_steps" not in values
    if key in ("material.name", "lattice.file"):
        return case_value is not None
    return key == "loading.speed" and case.loading.driven


def _why_no_memory(values: Mapping[str, Any]) -> str:
    """Why a measured memory has no effect: the config gives all of its numbers."""
    if values["material.memory"] != "measured":
        return ""
    stated = read_record(locate(values.get("material.name", "ninjaflex"))).memory
    others = {key for key in stated if f"material.{key}" not in values}
    if others - ({"loss"} if "material.relaxation_times" in values else set()):
        return ""
    return "the config itself gives what the file of the material states"


def _reason(key: str, values: Mapping[str, Any], case: Case) -> str:
    """Why the kinds of a case do not hold the value of a key."""
    table, name = key.split(".")
    kind = getattr(case, table)
    if key == "material.fibres":
        return f'material.bend is "{case.material.bend}"'
    if table == "lattice":
        return _reason_in_lattice(name, case)
    if ARCS in (name, case.solver.integrator) and table in ("contact", "solver", "loading"):
        return f'solver.integrator is "{case.solver.integrator}"'
    if key == "solver.load_steps" or (key == "solver.accuracy" and not case.loading.driven):
        return case.loading.because
    if key == "solver.accuracy":
        return f'solver.integrator is "{case.solver.integrator}"'
    if isinstance(kind, NoDamping):
        return _why_no_damping(values, case)
    rubs = not case.loading.quasi_static and isinstance(kind, Barrier)
    if rubs and key == "contact.slip_speed" and kind.friction == 0.0:
        return "contact.friction is 0"
    return str(kind.why_idle(name))


def _why_shells(case: Case) -> str:
    """Why the walls of a case are shells."""
    if case.lattice.sheet:
        return case.lattice.sheet_clause(case.lattice.inputs())
    return f'loading.direction is "{case.loading.direction}"'


def _why_no_damping(values: Mapping[str, Any], case: Case) -> str:
    if case.shells:
        return _why_shells(case)
    if case.loading.quasi_static:
        return STILL
    if "damping.model" not in values:
        return 'damping.model is "none" by default if the material relaxes'
    return NoDamping.because


def _reason_in_lattice(name: str, case: Case) -> str:
    if name in case.lattice.across and not case.shells:
        return f'loading.direction is "{ACROSS}"; needed: "{ALONG}"'
    if name == "imperfection_seed":
        return "lattice.imperfection is 0"
    return case.lattice.why_idle(name)
