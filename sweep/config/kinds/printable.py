"""Finds walls and gaps of a design that do not print as drawn, from the width of a line."""

from collections.abc import Sequence

from sweep.config.kinds.cells import Cells
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.drawn import Drawn
from sweep.config.kinds.lattice import Lattice
from sweep.config.kinds.sheet import Sheet, Surface
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.config.kinds.table import RefusedError
from sweep.constants import MM, TO_MM

TOLERANCE = 0.05  # of a line: how far a wall may be from a whole number of them
ROUND_OFF = 1e-9


def check_printable(lattice: Lattice) -> None:
    """Refuse what does not print if the lattice is to be `printable`."""
    wrong = what_does_not_print(lattice) if lattice.printable else ""
    if wrong:
        raise RefusedError("lattice.printable", True, f"false, as it has {wrong}")


def what_does_not_print(lattice: Lattice) -> str:
    """Walls that are no whole number of lines, and gaps narrower than one, in words; else empty.

    The walls of a slicer are lines. Of a custom structure gaps are not known.
    """
    width = _line_width(lattice)
    walls = [thickness / width for thickness in _thicknesses(lattice)]
    uneven = [lines for lines in walls if abs(lines - max(1, round(lines))) > TOLERANCE]
    wrong = [f"walls of {_span(uneven)} lines"] if uneven else []
    gap = _gap(lattice)
    if gap is not None and gap < width * (1.0 - ROUND_OFF):
        wrong.append(f"gaps of {gap / width:.2g} lines")
    return " and ".join(wrong) + (f" of {TO_MM * width:g} mm" if wrong else "")


def _line_width(lattice: Lattice) -> float:
    if isinstance(lattice, CustomStructure | Drawn | Sheet):
        return lattice.nozzle
    return lattice.line_width or lattice.nozzle


def _span(lines: Sequence[float]) -> str:
    least, most = (f"{end:.3g}" for end in (min(lines), max(lines)))
    return least if least == most else f"{least} to {most}"


def _thicknesses(lattice: Lattice) -> list[float]:
    """Thicknesses of the walls of the infill that have to be whole numbers of lines, m."""
    match lattice:
        case Sliced():
            return []
        case SlicedSheet():
            return []
        case Sheet():
            return [lattice.wall_thickness]
        case CustomStructure(structure=structure):
            return [MM * thickness for thickness in structure.thickness_mm]
        case Drawn():
            return sorted(set(lattice.network.wall_thickness.tolist()))
        case Cells(grading=1.0):
            return [lattice.wall_thickness]
    from sweep.design.box import gradient

    return [lattice.wall_thickness * float(part) for part in gradient(lattice.geometry)]


def _gap(lattice: Lattice) -> float | None:
    """Clear width of the narrowest cell, m; beside the double walls of a printed honeycomb."""
    match lattice:
        case CustomStructure() | Surface():
            return None
        case Sliced():
            double = lattice.printed_as.wall > 1.0
            return lattice.opening - (2.0 if double else 1.0) * lattice.lines
    return lattice.opening - max(_thicknesses(lattice))
