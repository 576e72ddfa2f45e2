"""The parameters of one case.

A `Case` is resolved when it is created (`resolve`), so that equal physics has an equal id.
"""

import json
from hashlib import blake2b
from typing import Any, Self, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator
from pydantic_core import from_json

from sweep.config.defaults.resolve import resolve
from sweep.config.lattice_limits import CUSTOM
from sweep.config.lattice_table import Lattice
from sweep.config.material_table import Material
from sweep.config.structures.structure import Structure
from sweep.config.structures.structure_file import faults
from sweep.config.tables import Contact, Damping, Loading, Solver, Table, canonical

__all__ = [
    "TABLES",
    "Case",
    "Contact",
    "Damping",
    "Lattice",
    "Loading",
    "Material",
    "Solver",
    "given",
]


MEASURED = ("width", "height", "depth", "wall_thickness")  # of a structure


class Case(BaseModel):
    """One simulation. `axes`: its values along the grid of its sweep, which are labels only."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    lattice: Lattice = Field(default_factory=Lattice)
    material: Material = Field(default_factory=Material)
    loading: Loading = Field(default_factory=Loading)
    contact: Contact = Field(default_factory=Contact)
    damping: Damping = Field(default_factory=Damping)
    solver: Solver = Field(default_factory=Solver)
    axes: dict[str, float | int | str | None] = {}

    @model_validator(mode="after")
    def _resolve(self) -> Self:
        tables, refused = resolve({name: getattr(self, name) for name in TABLES})
        if refused is not None:
            raise refused
        for name, table in tables.items():
            object.__setattr__(self, name, table)  # the model is frozen
        return self

    def changed(self, **tables: Any) -> "Case":
        """The case with other tables or labels, resolved anew."""
        return Case(**{name: getattr(self, name) for name in Case.model_fields} | tables)

    def to_json(self) -> str:
        """The case as text from which `from_json` makes an equal case."""
        return self.model_dump_json()

    @classmethod
    def from_json(cls, text: str) -> "Case":
        """The case of `to_json`, for which no file is read; `ValueError` if the text is no case."""
        try:
            tables, mass = _tables_of(text)
            case = cls.model_validate(tables)
        except ValidationError as error:
            raise ValueError(_first_fault(error)) from error
        lattice = case.lattice.model_copy(update={"mass": mass})
        return case.model_copy(update={"lattice": lattice})

    @property
    def case_id(self) -> str:
        """Hash of all parameters except labels: 16 hexadecimal digits."""
        tables = ",".join(f'"{name}":{canonical(getattr(self, name))}' for name in sorted(TABLES))
        return blake2b(f"{{{tables}}}".encode(), digest_size=8).hexdigest()


TABLES: dict[str, type[Table]] = {
    "lattice": Lattice,
    "material": Material,
    "loading": Loading,
    "contact": Contact,
    "damping": Damping,
    "solver": Solver,
}


def _tables_of(text: str) -> tuple[dict[str, Any], float | None]:
    """The tables of a text, which are completed from no file; and the mass that the lattice was
    given, from which its other numbers followed.
    """
    tables = from_json(text, allow_inf_nan=False)
    named = tables if isinstance(tables, dict) else {}
    lattice, material = (named.get(name) for name in ("lattice", "material"))
    if not isinstance(lattice, dict) or not isinstance(material, dict):
        raise ValueError("needed: a JSON object with the tables lattice and material")
    if "curve_strain" not in material:
        raise ValueError("material.curve_strain is missing")
    mass = lattice.pop("mass", None)
    if not (mass is None or (isinstance(mass, float) and mass > 0.0)):
        raise ValueError(f"lattice.mass = {mass!r}; allowed: null, or a number above 0")
    if lattice.get("kind") == CUSTOM:
        return named | {"lattice": _drawn(lattice)}, mass
    if lattice.get("structure") is not None:
        raise ValueError(f'lattice.structure; allowed only if lattice.kind is "{CUSTOM}"')
    return named, mass


def _drawn(lattice: dict[str, Any]) -> dict[str, Any]:
    """The keys of a custom lattice with its structure, from which its sizes are measured."""
    made = Structure.model_validate_json(json.dumps(lattice.get("structure")))
    for line in faults(made):
        raise ValueError(f"lattice.structure: {line}")
    given = {key: value for key, value in lattice.items() if key not in MEASURED}
    return given | {"structure": made}


def _first_fault(error: ValidationError) -> str:
    first = error.errors(include_url=False)[0]
    place = ".".join(map(str, first["loc"]))
    return f"{place}: {first['msg']}" if place else first["msg"]


T = TypeVar("T")


def given(value: T | None) -> T:
    """Return a parameter that is never None in a resolved case of this mode."""
    if value is None:
        raise ValueError("a resolved case has this parameter; this one was not resolved")
    return value
