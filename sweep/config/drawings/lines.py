"""The content of the file of a drawing: lines, and data of their walls."""

from typing import NamedTuple

from sweep.array_types import Floats
from sweep.constants import MM

METRES = {"um": 1e-3 * MM, "mm": MM, "cm": 10.0 * MM, "m": 1.0, "in": 25.4 * MM}
"""Units of length in the heads of a table."""


class Lines(NamedTuple):
    """Centre lines (s, 2, 2) in the unit of a file.

    unit: its length, m; None if the file does not state it. named: whether heads or keys of the
    file name it, so that no other can be meant. thickness: of the wall of each line (s,), in the
    same unit. depth: of the walls, m. elements: of a wall. notes: on parts that were left out.
    """

    ends: Floats
    unit: float | None = None
    thickness: Floats | None = None
    depth: float | None = None
    elements: int | None = None
    notes: tuple[str, ...] = ()
    named: bool = False
