"""The settings of a slicer that print a design: given in the config, or the nearest ones."""

from dataclasses import dataclass
from math import degrees, sqrt

from sweep.config.kinds.cells import Cells
from sweep.config.kinds.lattice import Lattice
from sweep.config.kinds.sheet import Sheet
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.config.kinds.specimen import LAYER_HEIGHT
from sweep.constants import TO_MM
from sweep.design.slicer.patterns import (
    LIKE,
    NEAREST,
    PATTERNS,
    PROGRAMS,
    line_of,
    share_of,
    width_of,
)
from sweep.numbers import percent

REGULAR = 0.05  # relative difference of a cell's proportions from the slicer's
WIDEST = 2.0  # nozzles: mean thickness of a line
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class SlicerSettings:
    """slicer: "prusa", "orca" or "cura". pattern: in the slicer's words. infill: share, 0 to 1.
    fill_multiline: number of lines of a wall. solid_layers: at the bottom and top of the print.

    line_width, of the infill, perimeter_width and layer_height in m; fill_angle in rad from the
    width of the design, whose layers are stacked along its depth, or, if it has solid ones, along
    its height. exact: False for a design that only corresponds to these settings; then the slicer's
    cells may be REGULAR longer or shorter, and be placed differently in the part.
    """

    slicer: str
    pattern: str
    infill: float
    line_width: float
    layer_height: float
    fill_angle: float
    perimeters: int
    perimeter_width: float
    exact: bool
    fill_multiline: int = 1
    solid_layers: int = 0

    def __str__(self) -> str:
        near = "" if self.exact else ", nearly"
        several = f"{self.fill_multiline} lines a wall, " if self.fill_multiline > 1 else ""
        return (
            f"{PROGRAMS[self.slicer].title}{near}: {self.pattern}, {100.0 * self.infill:.3g} %, "
            f"{several}line {TO_MM * self.line_width:.3g} mm, "
            f"layer {TO_MM * self.layer_height:.3g} mm, "
            f"angle {degrees(self.fill_angle):.3g} degrees, "
            f"{self.perimeters} perimeter{'' if self.perimeters == 1 else 's'}"
            + (f", {self.solid_layers} solid layers" if self.solid_layers else "")
        )


def slicer_settings(lattice: Lattice) -> SlicerSettings | None:
    """The settings that print a lattice; None if no infill of a slicer matches it (`unlike`)."""
    if isinstance(lattice, Sliced | SlicedSheet):
        return _own(lattice)
    return _nearest(lattice) if isinstance(lattice, Cells) and not unlike(lattice) else None


def unlike(lattice: Lattice) -> str:
    """Why no infill of a slicer matches a drawn lattice, and what would match; empty if one does.

    One matches if the lattice is whole and even, its cells are nearly regular, and its walls are as
    thick as the walls of the pattern with lines at least as wide as the nozzle that fill at most
    `WIDEST`.
    """
    if isinstance(lattice, Sheet):
        return (
            "walls of a slicer's sheet are thinner where it is inclined; allowed: lattice.slicer, "
            'with lattice.pattern "gyroid" or, of orca, "tpmsd"'
        )
    if not isinstance(lattice, Cells) or (lattice.kind, lattice.orientation) not in LIKE:
        kinds = ", ".join(dict.fromkeys(kind for kind, _ in LIKE))
        near = NEAREST.get(lattice.name)
        hint = f"; the nearest is {near}" if near else ""
        return f"no slicer draws {lattice.name} cells; allowed: {kinds}{hint}"
    even = {"boundary": "free", "sides": "free", "grading": 1.0, "solid_layers": 0}
    for key, value in even.items():
        if getattr(lattice, key) != value:
            return f"lattice.{key} = {getattr(lattice, key)}; allowed for a slicer: {value}"
    across, along = _scales(lattice)
    if abs(across / along - 1.0) > REGULAR:
        regular = f"{TO_MM * lattice.width * along / across:.4g} mm within {percent(REGULAR)} %"
        written = f"lattice.width = {TO_MM * lattice.width:.4g} mm"
        return f"{written}; allowed for a slicer: {regular}, where cells are regular"
    return _other_lines(lattice)


def _other_lines(lattice: Cells) -> str:
    """Why no lines make the walls of a lattice; empty if some do."""
    like, nozzle = LIKE[lattice.kind, lattice.orientation], lattice.nozzle
    thickness = lattice.wall_thickness
    written = f"lattice.wall_thickness = {TO_MM * thickness:.4g} mm"
    wall, height = PATTERNS[like.pattern].wall, lattice.layer_height or LAYER_HEIGHT
    least = wall * line_of("prusa", nozzle, height)
    most = wall * WIDEST * nozzle
    if not (1.0 - ROUND_OFF) * least <= thickness <= (1.0 + ROUND_OFF) * most:
        allowed = f"{TO_MM * least:.4g} to {TO_MM * most:.4g} mm"
        return f"{written}; allowed for a slicer: {allowed}, with a nozzle of {TO_MM * nozzle:g} mm"
    if not (share := _nearest(lattice).infill) < 1.0:
        return f"{written} makes an infill of {percent(share)} %; allowed for a slicer: below 100 %"
    return ""


def _nearest(lattice: Cells) -> SlicerSettings:
    """The settings of PrusaSlicer for the pattern that matches a drawn lattice."""
    like = LIKE[lattice.kind, lattice.orientation]
    across, along = _scales(lattice)
    height = lattice.layer_height or LAYER_HEIGHT
    line = lattice.wall_thickness / PATTERNS[like.pattern].wall
    around = lattice.line_printed if lattice.perimeters else line
    bordered = 1 if lattice.kind == "square" else 0  # its outer walls go all round
    return SlicerSettings(
        "prusa",
        like.pattern,
        share_of(like.pattern, like.distance * sqrt(across * along), line),
        width_of("prusa", line, height),
        height,
        like.angle,
        max(bordered, lattice.perimeters),
        width_of("prusa", around, height),
        exact=False,
    )


def _own(lattice: Sliced | SlicedSheet) -> SlicerSettings:
    """The settings with which the slicer of a lattice lays it."""
    return SlicerSettings(
        lattice.slicer,
        lattice.pattern,
        lattice.infill,
        lattice.line_width,
        lattice.layer_height,
        lattice.fill_angle,
        lattice.perimeters,
        lattice.line_width,
        exact=True,
        fill_multiline=lattice.fill_multiline,
        solid_layers=lattice.solid_layers if isinstance(lattice, Sliced) else 0,
    )


def _scales(lattice: Cells) -> tuple[float, float]:
    """Size of the box / size of the drawing in its own unit, in x and y."""
    from sweep.design.drawing import extent

    low, high = extent(lattice.kind, lattice.orientation, (lattice.cells_x, lattice.cells_y))
    width, height = high - low
    return lattice.width / float(width), lattice.height / float(height)
