"""The parameters of one case.

A `Case` is resolved when it is created (`resolve`), so that equal physics has an equal id.
"""

from hashlib import blake2b
from typing import Any, Self, TypeVar

from pydantic import BaseModel, ConfigDict, Field, model_validator

from sweep.config.defaults.resolve import resolve
from sweep.config.lattice_table import Lattice
from sweep.config.material_table import Material
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


T = TypeVar("T")


def given(value: T | None) -> T:
    """Return a parameter that is never None in a resolved case of this mode."""
    if value is None:
        raise ValueError("a resolved case has this parameter; this one was not resolved")
    return value
