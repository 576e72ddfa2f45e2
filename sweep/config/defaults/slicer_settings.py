"""The settings of a slicer that print a design: those of the config, or the nearest ones."""

from dataclasses import dataclass
from math import degrees, isclose, radians, sqrt
from typing import NamedTuple

from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.specimen import LAYER_HEIGHT
from sweep.constants import TO_MM
from sweep.design.slicer.patterns import PATTERNS, ROUNDED, SLICERS

NAMES = {"prusa": "PrusaSlicer", "orca": "OrcaSlicer", "cura": "Cura"}
REGULAR = 0.05  # relative difference of a cell's proportions from the slicer's
WIDEST = 2.0  # nozzles: width of a line


@dataclass(frozen=True)
class SlicerSettings:
    """slicer: "prusa", "orca" or "cura". pattern: in the slicer's words. infill: share, 0 to 1.
    fill_multiline: number of lines of a wall.

    line_width, layer_height in m; fill_angle in rad from the width of the design, whose layers are
    stacked along its depth. exact: False for a design that only corresponds to these settings; then
    the slicer's cells may be REGULAR longer or shorter, and lie otherwise in the part.
    """

    slicer: str
    pattern: str
    infill: float
    line_width: float
    layer_height: float
    fill_angle: float
    perimeters: int
    exact: bool
    fill_multiline: int = 1

    def __str__(self) -> str:
        near = "" if self.exact else ", nearly"
        several = f"{self.fill_multiline} lines a wall, " if self.fill_multiline > 1 else ""
        return (
            f"{NAMES[self.slicer]}{near}: {self.pattern}, {100.0 * self.infill:.3g} %, {several}"
            f"line {TO_MM * self.line_width:.3g} mm, layer {TO_MM * self.layer_height:.3g} mm, "
            f"angle {degrees(self.fill_angle):.3g} degrees, "
            f"{self.perimeters} perimeter{'' if self.perimeters == 1 else 's'}"
        )


class Likeness(NamedTuple):
    """A pattern of PrusaSlicer that a family looks like.

    distance: of parallel lines in the unit of the family. angle: of the first ones, rad.
    """

    pattern: str
    distance: float
    angle: float


LIKE = {
    ("square", None): Likeness("grid", 1.0, 0.0),
    ("diamond", None): Likeness("grid", sqrt(0.5), radians(45.0)),
    ("triangle", None): Likeness("triangles", sqrt(0.75), 0.0),
    ("kagome", None): Likeness("stars", sqrt(3.0), 0.0),
    ("hex", "pointy"): Likeness("honeycomb", sqrt(3.0), radians(30.0)),
    ("hex", "flat"): Likeness("honeycomb", sqrt(3.0), 0.0),
}


def slicer_settings(case: Case) -> SlicerSettings | None:
    """The settings that print a design; None if no infill of a slicer is like it.

    Without a slicer it corresponds to PrusaSlicer's if its cells are nearly regular, its walls even
    and as thick as one line of at most `WIDEST` nozzles, or, in a honeycomb, as 4/3 lines.
    """
    match case.lattice:
        case Cells() as lattice:
            return _nearest(lattice)
        case Sliced() as lattice:
            return SlicerSettings(
                lattice.slicer,
                lattice.pattern,
                lattice.infill,
                lattice.line_width,
                lattice.layer_height,
                lattice.fill_angle,
                lattice.perimeters,
                exact=True,
                fill_multiline=lattice.fill_multiline,
            )
    return None


def _nearest(lattice: Cells) -> SlicerSettings | None:
    like = LIKE.get((lattice.kind, lattice.orientation))
    if like is None or lattice.grading != 1.0 or lattice.endless:
        return None
    from sweep.design.drawing import extent

    cells = lattice.cells_x, lattice.cells_y
    low, high = extent(lattice.kind, lattice.orientation, cells)
    across, along = (lattice.width, lattice.height) / (high - low)
    pattern, height = PATTERNS[like.pattern], lattice.layer_height or LAYER_HEIGHT
    line = lattice.wall_thickness / pattern.wall
    width = line + height * ROUNDED
    share = pattern.directions * line / (like.distance * sqrt(across * along))
    fits = lattice.nozzle <= width <= WIDEST * lattice.nozzle and share < 1.0
    if not (fits and isclose(across, along, rel_tol=REGULAR)):
        return None
    bordered = 1 if lattice.kind == "square" else 0  # its outer walls go all round
    return SlicerSettings(
        "prusa",
        SLICERS["prusa"][like.pattern],
        float(share),
        width,
        height,
        like.angle,
        max(bordered, lattice.perimeters),
        exact=False,
    )
