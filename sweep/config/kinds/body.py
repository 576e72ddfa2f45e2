"""The body that a loading presses."""

from math import inf
from typing import NamedTuple

from sweep.config.kinds.direction import WHERE
from sweep.config.kinds.specimen import ENDLESS, TIED
from sweep.config.structures.structure import Structure


class Body(NamedTuple):
    """The pressed body: its height (m), whether along the cells; the structure of a file with
    loads; whether it is endless, whether its sides are tied to each other; its width (m); why its
    walls are a sheet, as a clause; the diagonal of its drawing (m), the volume of its box (m^3).
    """

    height: float
    along: bool
    structure: Structure | None = None
    endless: bool = False
    tied_sides: bool = False
    width: float = inf
    sheet: str = ""
    diagonal: float = 1.0
    volume: float = 0.0

    @property
    def shells(self) -> bool:
        """Whether the walls are shells in space."""
        return self.along or bool(self.sheet)

    @property
    def where(self) -> str:
        """Why its walls are shells, as part of a sentence."""
        return f"if {self.sheet}" if self.sheet else WHERE

    @property
    def unending(self) -> str:
        """Why the lattice has no middle that could be struck; empty if it has."""
        if self.sheet:
            return self.where
        return ENDLESS if self.endless else TIED if self.tied_sides else ""

    def compliance(self, modulus: float) -> float:
        """Compliance (m/N) of a solid block of a modulus (Pa): c = h^2 / (Y V)."""
        return self.height**2 / (modulus * self.volume) if self.volume else inf
