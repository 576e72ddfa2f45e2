"""A gyroid as a slicer prints it: in each layer a line along the curve that cuts the sheet."""

from math import pi
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from sweep.config.kinds.sheet import Surface, checked, fitted
from sweep.config.kinds.sliced import MOST_LINES
from sweep.config.kinds.specimen import LAYER_HEIGHT, Specimen
from sweep.config.kinds.table import Given, Length, RefusedError, Share, chosen
from sweep.design.slicer.patterns import PROGRAMS, line_of, spread_lines
from sweep.design.surfaces.names import SHEETS

GYROID = "gyroid"
LEAST_SHARE = 0.02


class SlicedSheet(Surface):
    """The infill "gyroid" of a slicer, without perimeters.

    A line of mean thickness s, or several side by side, makes the sheet s |n_xy| thick, n its
    normal, and at least as thick as a layer is high. `infill` is the share whose period fits the
    height pressed, nearest to the one given.
    """

    because: ClassVar[str] = "lattice.slicer prints a sheet, one period of which is computed"
    derived: ClassVar[tuple[str, ...]] = (*Surface.derived, "wall_thickness")

    slicer: Literal["prusa", "orca", "cura"]
    pattern: Literal["gyroid"]
    infill: Share
    fill_multiline: Annotated[int, Field(ge=1, le=MOST_LINES)] = 1
    line_width: Length
    layer_height: Length = LAYER_HEIGHT

    @property
    def sheet(self) -> str:
        """The name of the surface."""
        return self.pattern

    @property
    def extruded(self) -> float:
        """Volume as extruded, m^3."""
        return self.wall_thickness * SHEETS[self.sheet].steep * self.area


def sliced_sheet(given: Given, along: bool) -> SlicedSheet:
    """The gyroid of these values; along: whether it is pressed along the print axis."""
    program = PROGRAMS[given["slicer"]]
    width = given.get("nozzle", Specimen.model_fields["nozzle"].default)
    width = given.get("line_width", width * program.nozzles)
    layer, lines = given.get("layer_height", LAYER_HEIGHT), given.get("fill_multiline", 1)
    _check(given, width, layer, lines)
    one = line_of(given["slicer"], width, layer)
    line, spread = lines * one, spread_lines(given["slicer"], lines) * one
    wanted = period_of(given["slicer"], given["infill"], spread)
    sides = fitted(GYROID, given, along, wanted, "infill")
    follows: dict[str, Any] = {
        "wall_thickness": line,
        "line_width": width,
        "infill": period_of(given["slicer"], 1.0, spread) / sides["period"],
    }
    return checked(SlicedSheet.model_validate(chosen(given, SlicedSheet) | sides | follows))


def period_of(slicer: str, share: float, line: float) -> float:
    """Period (m) of a gyroid of a share r of infill; line: s, m, or that of the lines of a wall.

    2 pi s / (2.44 r) in PrusaSlicer and OrcaSlicer, 2.41 s / r in Cura, as read in their sources.
    """
    return (2.0 * pi / 2.44 if PROGRAMS[slicer].rounded else 2.41) * line / share


def _check(given: Given, width: float, layer: float, lines: int) -> None:
    """Refuse a share, a mass or lines that a slicer's gyroid does not have; width, layer: m."""
    if "infill" not in given:
        raise RefusedError("lattice.infill", None, 'a share such as "15 %"')
    if given["infill"] < LEAST_SHARE:
        raise RefusedError("lattice.infill", given["infill"], f"at least {100 * LEAST_SHARE:g} %")
    if layer > width:
        raise RefusedError("lattice.layer_height", layer, f"at most the line width, {width:g} m")
    if lines > PROGRAMS[given["slicer"]].lines:
        raise RefusedError(
            "lattice.fill_multiline", lines, '1; more with lattice.slicer "orca" or "cura"'
        )
