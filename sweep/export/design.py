"""The printed design of a case."""

from dataclasses import dataclass

from sweep.config.case import Case
from sweep.config.kinds.sliced import Sliced
from sweep.design.lattice import counted_area
from sweep.design.network import Network, mass
from sweep.export.errors import ExportError
from sweep.numbers import in_unit


@dataclass(frozen=True)
class Design:
    """The printed part of a case. network: the drawing; grams: mass of one specimen."""

    case: Case
    network: Network
    grams: float

    @property
    def extruded_grams(self) -> float | None:
        """Mass of one specimen as its slicer extrudes it, which budgets count; None without a
        slicer.
        """
        lattice = self.case.lattice
        if not isinstance(lattice, Sliced):
            return None
        return self.grams * counted_area(lattice.geometry) / self.network.printed_area

    @property
    def volume(self) -> float:
        """Mass / density, m^3: the printed area x the depth."""
        return self.network.printed_area * self.case.lattice.depth


def design_of(case: Case) -> Design:
    """The design of a case; a period is no part, and is refused."""
    if case.lattice.endless:
        raise ExportError(
            f"case {case.case_id} is one period of an endless lattice (lattice.boundary), which is "
            "no part; allowed: .csv, .vtkhdf, .gif"
        )
    if case.lattice.sheet:
        raise ExportError(
            f"case {case.case_id} is a sheet, which has no outline; allowed: .stl and .3mf with a "
            "panel, .csv, .vtkhdf, .gif"
        )
    if case.lattice.tied_sides:
        raise ExportError(
            f"case {case.case_id} is one period of a wide panel, which is no part; "
            'allowed: lattice.sides = "free", or .csv, .vtkhdf, .gif'
        )
    network = case.lattice.network
    kilograms = mass(network, case.lattice.depth, case.material.density)
    return Design(case, network, in_unit(kilograms, "g"))
