"""Crushes of strips of a panel: more and more cells side by side, with free and with tied sides."""

from typing import NamedTuple

from sweep.config.case import Case
from sweep.design.drawing import extent, pitch
from sweep.design.infill import families, trait

CELL, HEIGHT, ROWS, THICKNESS = 12.5e-3 / 3, 12.5e-3, 3, 0.4e-3
STRAIN, STEPS, PATIENCE = 0.5, 200, 900.0  # s for a case
NARROW, WIDE, WIDEST = (3, 6, 12), (24, 48), 96  # cells side by side
PLATENS = {"glued": ("glued", 0.3), "loose": ("contact", 0.3), "smooth": ("contact", 0.0)}
"""Platens and their friction; between smooth ones the period of tied sides is free."""
FAR = ("loose",)  # platens whose friction brings free sides to bear far into a panel


class Strip(NamedTuple):
    """A specimen: its infill, its platens, its sides, and cells side by side."""

    kind: str
    platens: str
    sides: str
    cells: int


def strips(kinds=None, platens=tuple(PLATENS), narrow=NARROW):
    """The strips of the study, the narrow ones first."""
    pairs = [(n, sides) for n in narrow for sides in ("free", "periodic")]
    return [
        Strip(kind, platen, sides, n)
        for kind in kinds or families()
        for platen in platens
        for n, sides in (*pairs, *((n, "free") for n in wide(platen)))
    ]


def wide(platens):
    """Cells side by side of the wide strips; the last two give the middle of a panel."""
    return (*WIDE, WIDEST) if platens in FAR else WIDE


def width_of(strip):
    """Width over centre lines, m; of tied sides, the period."""
    if strip.sides == "periodic":
        return CELL * strip.cells
    way = "pointy" if trait(strip.kind, "ORIENTED") else None
    low, high = extent(strip.kind, way, (strip.cells, ROWS))
    return float(CELL * (high - low)[0] / pitch(strip.kind, way)[0])


def crush(strip):
    """The crush of a strip."""
    platen, friction = PLATENS[strip.platens]
    lattice = {
        "kind": strip.kind,
        "sides": strip.sides,
        "cells_x": strip.cells,
        "cells_y": ROWS,
        "width": width_of(strip),
        "height": HEIGHT,
        "wall_thickness": THICKNESS,
    }
    return Case.of(
        lattice=lattice,
        loading=dict(mode="displacement", strain=STRAIN, platen=platen, unload=False),
        contact=dict(friction=friction),
        solver=dict(time_limit=PATIENCE, load_steps=STEPS),
    )
