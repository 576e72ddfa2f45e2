"""Reads the file of a drawing in any format, and joins its walls.

A file may come from anywhere: its size, and the number of lines that follow from it, are bounded.
"""

from functools import lru_cache
from pathlib import Path
from stat import S_ISREG
from typing import NamedTuple

import numpy as np

from sweep.config.drawings import dxf, svg, tables
from sweep.config.drawings.curves import MOST_LINES
from sweep.config.drawings.lines import Lines
from sweep.config.faults import MisfitError
from sweep.config.structures.structure import pieces_of
from sweep.config.structures.structure_file import StructureError
from sweep.design.meeting import Meeting, MeetingError, met
from sweep.numbers import in_unit, text_in

READERS = {**tables.READERS, ".dxf": dxf.read_dxf, ".svg": svg.read_svg}
NEEDED = "the path of a .svg, .dxf, .csv or .json file, or of LAMMPS data (.data, .lmp)"
MOST_BYTES = 8_000_000
MOST_BYTES_OF_SVG = 2_000_000  # formats whose paths are read slowly
FARTHEST = 1e9  # units of the file


class Read(NamedTuple):
    """A network in one piece, and the remarks on its file."""

    network: Meeting
    lines: Lines


def read_drawing(path: Path) -> Read:
    """Read a file once; raises `StructureError` with the reason if it is no drawing."""
    try:
        state = path.stat()
        if not S_ISREG(state.st_mode):
            raise MisfitError(f"not a file; needed: {NEEDED}")
        if path.suffix.lower() not in READERS:
            raise MisfitError(f"not the name of a drawing; needed: {NEEDED}")
        most = MOST_BYTES_OF_SVG if path.suffix.lower() == ".svg" else MOST_BYTES
        if state.st_size > most:
            raise MisfitError(f"larger than {text_in(most, 'MB')}")
        return _read(path, state.st_mtime_ns)
    except OSError as error:
        raise StructureError([f"cannot be read ({error.strerror}); needed: {NEEDED}"]) from None
    except ValueError as error:  # one of ours, or a null character in the path
        if isinstance(error, StructureError):
            raise
        ours = isinstance(error, MisfitError | MeetingError)
        raise StructureError([str(error) if ours else f"no path; needed: {NEEDED}"]) from None


@lru_cache(maxsize=16)
def _read(path: Path, _: int) -> Read:
    """`read_drawing` for a file of this age."""
    lines = READERS[path.suffix.lower()](path)
    ends = lines.ends
    if not 0 < len(ends) <= MOST_LINES:
        raise MisfitError(f"has {len(ends):,} lines; needed: 1 to {MOST_LINES:,}")
    if np.abs(ends).max() > FARTHEST:
        raise MisfitError(f"reaches farther than {FARTHEST:g} from its origin")
    if lines.thickness is not None and not lines.thickness.min() > 0.0:
        raise MisfitError(f"has a wall of thickness {lines.thickness.min():g}; needed: above 0")
    width, height = np.ptp(ends, axis=(0, 1))
    if min(width, height) <= 0.0:
        size = _pair(lines, width, height, " x ")
        raise MisfitError(f"its lines span {size}; needed: lines in the plane")
    network = met(ends - ends.min(axis=(0, 1)))
    _check_piece(network, lines)
    return Read(network, lines)


def _check_piece(network: Meeting, lines: Lines) -> None:
    """Refuse walls that are not connected with the others."""
    joints = network.joints
    piece = np.array(pieces_of(len(joints), network.walls))
    count = piece.max() + 1
    if count > 1:
        sizes = np.bincount(piece)
        x, y = joints[np.argmax(piece == np.argmin(sizes))]
        place = _pair(lines, x, y, ", ")
        raise MisfitError(
            f"in {count} pieces: nothing holds the walls at {place} from its lower left corner; "
            "needed: walls that all meet"
        )


def _pair(lines: Lines, x: float, y: float, between: str) -> str:
    """Two lengths of a file, in mm if it names its unit."""
    if lines.named and lines.unit:
        return f"{in_unit(lines.unit * x, 'mm'):.4g}{between}{text_in(lines.unit * y, 'mm', 4)}"
    return f"{x:.4g}{between}{y:.4g} of its units"
