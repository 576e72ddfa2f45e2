"""One case: a lattice of a material under a loading, with contact, damping and a solver.

`complete` makes a case from the values that a config gives, and from the defaults that follow from
them, so that equal physics has an equal id.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import blake2b
from math import hypot, inf
from typing import Any, TypeVar, Unpack

from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import ErrorDetails

from sweep.config.changes import merged
from sweep.config.faults import MisfitError
from sweep.config.keys import table_keys
from sweep.config.kinds import contact as contacts
from sweep.config.kinds import damping as dampings
from sweep.config.kinds import loading as loadings
from sweep.config.kinds import material as materials
from sweep.config.kinds import steps
from sweep.config.kinds.body import Body
from sweep.config.kinds.contact import Contact
from sweep.config.kinds.damping import Damping
from sweep.config.kinds.direction import is_along
from sweep.config.kinds.lattice import TAGS, AnyLattice, Lattice, kind_of, lattice_of
from sweep.config.kinds.loading import AnyLoading
from sweep.config.kinds.material import Material
from sweep.config.kinds.solver import Solver
from sweep.config.kinds.specimen import pressed_height
from sweep.config.kinds.table import (
    TABLES,
    Inputs,
    RefusedError,
    Table,
    Tables,
    canonical,
    keys_of,
)

T = TypeVar("T")

TABLES_KEPT = 20_000  # tables of a sweep, 2 kB each


class Case(BaseModel):
    """One simulation, complete. `axes`: its values along the grid of its sweep, labels only."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    lattice: AnyLattice
    material: Material
    loading: AnyLoading
    contact: Contact
    damping: Damping
    solver: Solver
    axes: dict[str, float | int | str | None] = {}

    @staticmethod
    def of(axes: Mapping[str, Any] | None = None, **tables: Unpack[Tables]) -> "Case":
        """The case of these values by table and key, in SI; a key that is None has its default.

        `RefusedError` says which values contradict each other, which keys a table of its kind has,
        or that there is no such table.
        """
        contents = {name: _values(values) for name, values in _checked(tables).items()}
        case = complete(contents).sound(axes)
        for name, values in contents.items():
            _check_keys(getattr(case, name), name, values)
        return case

    def __repr__(self) -> str:
        words = f"{self.lattice.name} of {self.material.name}, {self.loading.mode}"
        return f"<Case {self.case_id}: {words}>"

    __str__ = __repr__

    @property
    def along(self) -> bool:
        """Whether the lattice is pressed along its cells, out of the plane of its drawing."""
        return self.loading.along

    @property
    def shells(self) -> bool:
        """Whether its walls are shells in space: pressed along the cells, or of a sheet."""
        return self.along or bool(self.lattice.sheet)

    @property
    def height(self) -> float:
        """The height that a platen or a striker presses, m."""
        return self.lattice.depth if self.along else self.lattice.height

    @property
    def pressed(self) -> Body:
        """The body that is pressed."""
        return _pressed(self.lattice, self.along, {})

    @property
    def footprint(self) -> tuple[float, float]:
        """Outer width and depth (m) of the pressed area."""
        width, height = self.lattice.outer_size
        return (width, height) if self.along else (width, self.lattice.depth)

    @property
    def widens(self) -> bool:
        """Whether the width of the period of tied sides is free: neither a platen nor inertia holds
        it.

        Between platens without friction the mean lateral force of a crush is zero. An endless panel
        that moves cannot widen in a finite time. The periods of shells are fixed.
        """
        loose = self.loading.platen == "contact" and self.contact.friction == 0.0
        return self.lattice.tied_sides and not self.shells and loose and self.loading.quasi_static

    def __hash__(self) -> int:
        """Equal cases have equal ids; labels, which may differ, are no part of them."""
        return hash(self.case_id)

    @cached_property
    def case_id(self) -> str:
        """Hash of all parameters except labels: 16 hexadecimal digits."""
        tables = ",".join(f'"{name}":{canonical(getattr(self, name))}' for name in sorted(TABLES))
        return blake2b(f"{{{tables}}}".encode(), digest_size=8).hexdigest()

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> "Case":
        """The case with other tables, or other labels, which alone do not change its id."""
        copied = super().model_copy(update=update, deep=deep)
        if set(update or ()) - {"axes"}:
            copied.__dict__.pop("case_id", None)
        return copied

    def changed(self, axes: Mapping[str, Any] | None = None, **tables: Unpack[Tables]) -> "Case":
        """The case with other values, by table and key, completed anew; None drops a value.

        axes: further labels. `changes` says which of its own values a new one replaces; the others
        stay, such as a duration or a time step that followed from old ones.
        """
        return self._changed(self.axes | dict(axes or {}), tables)

    def _changed(
        self, labels: dict[str, Any], tables: Tables, cache: dict[Any, Any] | None = None
    ) -> "Case":
        changes = {name: dict(change) for name, change in _checked(tables).items()}
        values = merged({name: getattr(self, name) for name in TABLES}, changes)
        inputs = {name: _values(table) for name, table in values.items()}
        case = complete(inputs, cache).sound(labels)
        for name, change in changes.items():
            _check_keys(getattr(case, name), name, _values(change))
        return case

    def to_json(self) -> str:
        """The case as JSON text, which `from_json` reads."""
        return self.model_dump_json()

    @staticmethod
    def from_json(text: str | bytes, cache: dict[Any, Any] | None = None) -> "Case":
        """The case that `to_json` wrote, without reading files; raises `MisfitError` if the text is
        no case.

        cache: the tables of other cases so far, see `Draft`.
        """
        try:
            case = Case.model_validate_json(text)
        except ValidationError as error:
            first = error.errors(include_url=False)[0]
            place = ".".join(str(part) for part in first["loc"] if part not in TAGS) or "the text"
            raise MisfitError(f"{place}: {first['msg']}") from None
        again = case._changed(case.axes, {}, cache)
        same = all(getattr(again, name) == getattr(case, name) for name in TABLES)
        if not same and again.case_id != case.case_id:
            raise MisfitError("its numbers do not follow from one another")
        return case


@dataclass
class Draft:
    """A case that is being completed: its tables so far, and the refused values.

    cache: tables by the values they are made from, as the cases of a sweep share most of them; it
    is emptied when it holds `TABLES_KEPT`.
    """

    cache: dict[Any, Any] = field(default_factory=dict)
    tables: dict[str, Table] = field(default_factory=dict)
    refused: list[RefusedError] = field(default_factory=list)

    def add(self, name: str, make: Callable[..., T], *values: Any) -> T | None:
        """Make a table, or record why it cannot be made."""
        key = (name, *(tuple(v.items()) if isinstance(v, dict) else v for v in values))
        try:
            if key not in self.cache:
                if len(self.cache) >= TABLES_KEPT:
                    self.cache.clear()
                self.cache[key] = make(*values)
        except RefusedError as error:
            self.refused += [error, *error.also]
            return None
        except ValidationError as error:
            self.refused += [_refused(name, wrong) for wrong in error.errors()]
            return None
        table: T = self.cache[key]
        self.tables[name] = table  # type: ignore[assignment]
        return table

    def sound(self, axes: Mapping[str, Any] | None = None) -> Case:
        """The case, with these labels; raises the first refusal if there is one."""
        if self.refused:
            raise self.refused[0]
        values: dict[str, Any] = {**self.tables, "axes": dict(axes or {})}
        return Case.model_construct(keys_of(Case), **values)


def complete(inputs: Mapping[str, Inputs], cache: dict[Any, Any] | None = None) -> Draft:
    """The case of the values of each table, in SI. cache: the tables of a sweep so far: `Draft`.

    The loading is checked even if the material and the lattice are refused; of the numerical
    settings, the first refusal ends it.
    """
    draft = Draft({} if cache is None else cache)
    own = {name: _hashable(inputs.get(name, {})) for name in TABLES}
    along, integrator = is_along(own["loading"]), own["solver"].get("integrator")
    pressed = _pressed(None, along, own["lattice"])
    where = pressed.where if pressed.shells else ""
    material = draft.add("material", materials.material, own["material"], where)
    density = material.density if material else None
    lattice = None
    if density or "mass" not in own["lattice"]:
        lattice = draft.add("lattice", lattice_of, own["lattice"], density or 1.0, along)
    pressed = _pressed(lattice, along, own["lattice"])
    relaxes = material.relaxes if material else materials.relaxes(own["material"])
    loading = draft.add("loading", loadings.loading, own["loading"], pressed, integrator, relaxes)
    if loading is None or material is None:
        return draft
    by_position = own["contact"].get("model") == "position_based"
    steps_from = (own["solver"], material, loading, pressed, by_position)
    if solver := draft.add("solver", steps.solver, *steps_from):
        contact = (own["contact"], loading, pressed, solver.integrator)
        if draft.add("contact", contacts.contact, *contact):
            draft.add("damping", dampings.damping, own["damping"], loading, pressed, relaxes)
            draft.add("solver", steps.in_the_plane, solver, material, loading, pressed.shells)
    return draft


def _pressed(lattice: Lattice | None, along: bool, inputs: Inputs) -> Body:
    """The body that is pressed; for a refused lattice, from its given values."""
    if lattice is None:
        height, sheet = pressed_height(inputs, along), kind_of(inputs).sheet_clause(inputs)
        return Body(height, along, width=inputs.get("width", inf), sheet=sheet)
    width, height, depth = lattice.width, lattice.height, lattice.depth
    return Body(
        depth if along else height,
        along,
        lattice.loaded,
        lattice.endless,
        lattice.tied_sides,
        width,
        lattice.sheet_clause(lattice.inputs()),
        hypot(width, height),
        width * height * depth,
    )


def _refused(table: str, wrong: ErrorDetails) -> RefusedError:
    """The refusal of a value of the wrong type or out of range."""
    allowed = wrong["msg"].removeprefix("Input should be ")
    allowed = allowed.replace("a valid number", "a number in SI")
    return RefusedError(f"{table}.{wrong['loc'][0]}", wrong["input"], allowed)


def _values(table: Inputs | Table) -> dict[str, Any]:
    """The values of a table that are not None."""
    values = table.inputs() if isinstance(table, Table) else table
    return {key: value for key, value in values.items() if value is not None}


def _checked(tables: Mapping[str, Any]) -> dict[str, Inputs | Table]:
    """The given tables; refuses tables that no case has, and values that are no table."""
    present = {name: values for name, values in tables.items() if values is not None}
    for name, values in present.items():
        if name not in TABLES:
            raise RefusedError(name, values, f"the tables {', '.join(TABLES)}")
        if isinstance(values, Mapping):
            _check_types(name, values)
        elif not isinstance(values, Table):
            raise RefusedError(name, values, "values by key")
    return present


def _check_types(table: str, values: Inputs) -> None:
    """Refuse a value of a type that its key does not have, such as a text for a number."""
    keys = table_keys(table)
    for key, value in values.items():
        if value is None or f"{table}.{key}" not in keys:
            continue
        try:
            keys[f"{table}.{key}"].adapter.validate_python(value)
        except ValidationError as error:
            wrong = error.errors(include_url=False)[0]
            if wrong["type"].endswith("_type") or isinstance(value, list | dict):
                raise _refused(table, wrong | {"loc": (key,)}) from None


def _check_keys(table: Table, name: str, values: Inputs) -> None:
    """Refuse a key that the kind of a table does not have."""
    for key, value in values.items():
        if not (key in type(table).model_fields or table.implies(key, value)):
            allowed = f"a key of {type(table).__name__}: {', '.join(type(table).model_fields)}"
            raise RefusedError(f"{name}.{key}", value, allowed)


def _hashable(values: Inputs) -> dict[str, Any]:
    """Values that the cache of a draft can look up."""
    return {key: tuple(v) if isinstance(v, list) else v for key, v in values.items()}
