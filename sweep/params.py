"""The parameters of one case.

A `Case` is resolved when it is made (sweep/resolve.py), so that equal physics has an equal id.
"""

from functools import cached_property
from hashlib import blake2b
from typing import Self

from pydantic import BaseModel, ConfigDict, model_validator

from sweep.resolve import resolved_contact, resolved_damping, resolved_loading, resolved_solver
from sweep.tables import Contact, Damping, Lattice, Loading, Material, Solver, Table

__all__ = [
    "TABLES",
    "Case",
    "Contact",
    "Damping",
    "Lattice",
    "Loading",
    "Material",
    "Solver",
]


class Case(BaseModel):
    """One simulation. `axes` are its values along the grid of its sweep: labels, not physics."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    lattice: Lattice = Lattice()
    material: Material = Material()
    loading: Loading = Loading()
    contact: Contact = Contact()
    damping: Damping = Damping()
    solver: Solver = Solver()
    axes: dict[str, float | int | str | None] = {}

    @model_validator(mode="after")
    def _resolve(self) -> Self:
        loading = resolved_loading(self.loading, self.lattice, self.solver)
        resolved = {
            "loading": loading,
            "contact": resolved_contact(self.contact, loading),
            "damping": resolved_damping(self.damping, loading),
            "solver": resolved_solver(self.solver, loading),
        }
        for name, table in resolved.items():
            object.__setattr__(self, name, table)  # frozen from here on
        return self

    @cached_property
    def case_id(self) -> str:
        """Hash of every parameter but the labels: 16 hexadecimal digits."""
        tables = ",".join(f'"{name}":{getattr(self, name).canonical}' for name in sorted(TABLES))
        return blake2b(f"{{{tables}}}".encode(), digest_size=8).hexdigest()


TABLES: dict[str, type[Table]] = {
    name: field.annotation for name, field in Case.model_fields.items() if name != "axes"
}
