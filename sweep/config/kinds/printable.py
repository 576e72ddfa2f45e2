"""Finds walls and gaps of a design that do not print as drawn, from the width of a line."""

from collections.abc import Sequence

from sweep.config.kinds.specimen import Specimen
from sweep.constants import TO_MM

TOLERANCE = 0.05  # share of a line by which a wall may deviate from a whole number of lines
ROUND_OFF = 1e-9


def check_printable(lattice: Specimen) -> None:
    """Refuse walls and gaps that do not print if the lattice must be `printable`."""
    wrong = what_does_not_print(lattice) if lattice.printable else ""
    if wrong:
        raise lattice.refusal("printable", f"false, or another design, as {wrong} do not print")


def what_does_not_print(lattice: Specimen) -> str:
    """Walls that are no whole number of lines, and gaps narrower than a line, in words; else
    empty.
    """
    width, gap = lattice.line_printed, lattice.gap_printed
    walls = [thickness / width for thickness in lattice.walls_printed]
    uneven = [lines for lines in walls if abs(lines - max(1, round(lines))) > TOLERANCE]
    wrong = [f"walls of {_span(uneven)} lines"] if uneven else []
    if gap is not None and gap < width * (1.0 - ROUND_OFF):
        wrong.append(f"gaps of {gap / width:.2g} lines")
    return " and ".join(wrong) + (f" of {TO_MM * width:g} mm" if wrong else "")


def _span(lines: Sequence[float]) -> str:
    least, most = (f"{end:.3g}" for end in (min(lines), max(lines)))
    return least if least == most else f"{least} to {most}"
