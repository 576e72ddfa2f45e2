"""Reads the lines and curves of a DXF file, including its blocks, with the package ezdxf."""

from collections import Counter
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from sweep.array_types import Floats
from sweep.config.drawings.curves import MOST_LINES, straightened, without_marks
from sweep.config.drawings.lines import METRES, Lines
from sweep.config.faults import MisfitError

LINES = {"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"}
UNITS = METRES | {"ft": 12.0 * METRES["in"], "mil": 1e-3 * METRES["in"], "µm": METRES["um"]}
"""Units of $INSUNITS that drawings of lattices have."""
PLANE = 1e-6  # share of the greatest coordinate: higher points are not in the plane


def read_dxf(path: Path) -> Lines:
    """The lines of the model space, in the plane x, y, except in layers that are off."""
    try:
        from ezdxf import recover
        from ezdxf.disassemble import recursive_decompose
        from ezdxf.filemanagement import readfile
        from ezdxf.lldxf.const import DXFStructureError
        from ezdxf.units import decode
    except ModuleNotFoundError as missing:
        needed = 'a .dxf file needs the package ezdxf: pip install ezdxf, or "crumple[drawings]"'
        raise MisfitError(needed) from missing
    left_out: Counter[str] = Counter()
    notes: list[str] = []
    try:
        try:
            document = readfile(path)
        except DXFStructureError:
            document, _ = recover.readfile(path)
            notes.append("of an old form or damaged, and repaired by ezdxf: look at its walls")
        entities = [*islice(recursive_decompose(document.modelspace()), MOST_LINES + 1)]
        if len(entities) > MOST_LINES:
            raise MisfitError(f"more than {MOST_LINES:,} entities")
        hidden = {
            layer.dxf.name for layer in document.layers if layer.is_off() or layer.is_frozen()
        }
        ends, marks = without_marks(straightened(_curves(entities, hidden, left_out)))
        unit = UNITS.get(str(decode(document.units)))
    except MisfitError:
        raise
    except Exception as error:  # noqa: BLE001  a damaged file fails anywhere in its reader
        raise MisfitError(f"not DXF that ezdxf can read ({type(error).__name__})") from None
    counts = [f"{count} x {what}" for what, count in sorted(left_out.items())]
    parts = ", ".join([*counts, *marks])
    notes += [f"left out: {parts}"] if parts else []
    return Lines(ends, unit, notes=tuple(notes))


def _curves(entities: list[Any], hidden: set[str], left_out: Counter[str]) -> Iterator[Floats]:
    """Control points of all lines and curves; counts the entities that are left out."""
    from ezdxf.path import make_path

    for entity in entities:
        kind, layer = entity.dxftype(), entity.dxf.get("layer", "0")
        if kind not in LINES:
            left_out[kind] += 1
        elif layer in hidden or entity.dxf.get("invisible", 0):
            left_out["hidden line"] += 1
        else:
            yield from _beziers(make_path(entity))


def _beziers(path: Any) -> Iterator[Floats]:
    """Control points (k, 2) of each part of a path."""
    points = np.array([(*point,) for point in path.control_vertices()])
    if np.ptp(points[:, 2]) > PLANE * np.abs(points).max():
        raise MisfitError("has lines that are not in the plane of x and y")
    start = path.start
    for command in path.commands():
        if command.type.name != "MOVE_TO":
            inner = [getattr(command, name) for name in command._fields[1:]]
            yield np.array([(p.x, p.y) for p in (start, *inner, command.end)])
        start = command.end
