"""A sheet as a slicer prints it: in each layer a line along the curve that cuts the sheet."""

from collections.abc import Mapping
from math import cos, isclose, isinf
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from sweep.config.kinds.direction import ALONG
from sweep.config.kinds.sheet import (
    LEAST,
    NARROW,
    SIDES,
    THICKEST,
    Surface,
    checked,
    fitted,
    narrowest,
    widest,
)
from sweep.config.kinds.sliced import FILL_ANGLE, MOST_LINES, check_layer, line_width_of, names_in
from sweep.config.kinds.specimen import LAYER_HEIGHT, Lines, pressed_height
from sweep.config.kinds.table import Angle, Inputs, Length, RefusedError, Share, own_values
from sweep.design.slicer.patterns import (
    PROGRAMS,
    SHEET_PATTERNS,
    SheetPattern,
    line_of,
    spread_lines,
)
from sweep.design.surfaces.names import BLOCK, SHEETS
from sweep.numbers import at_least, at_most, in_unit, text_in

LEAST_SHARE = 0.02
HELD = "lattice.perimeters hold the sides of a block"


class SlicedSheet(Surface):
    """The infill "gyroid" or "tpmsd" of a slicer: of a panel, or of a block within `perimeters`.

    A line of mean thickness s, or several side by side, makes the sheet s |n_xy| thick, n its
    normal, and at least as thick as a layer is high. `infill` is the share, nearest to the given
    one, whose period fits the pressed height. At a `fill_angle` of 45 degrees its axes lie along
    the sides of the part, at 0 and 90 degrees between them.
    """

    derived: ClassVar[tuple[str, ...]] = (*Surface.derived, "wall_thickness")
    fits: ClassVar[tuple[str, ...]] = ("infill", *SIDES)
    replaces: ClassVar[dict[str, tuple[str, ...]]] = {"wall_thickness": ("infill",)}

    slicer: Literal["prusa", "orca", "cura"]
    pattern: Literal["gyroid", "tpmsd"]
    infill: Share
    fill_angle: Angle = FILL_ANGLE
    fill_multiline: Annotated[int, Field(ge=1, le=MOST_LINES)] = 1
    line_width: Length
    layer_height: Length = LAYER_HEIGHT
    perimeters: Lines = 0

    @classmethod
    def means(cls, inputs: Inputs) -> bool:
        """Whether values mean this kind of lattice."""
        return inputs.get("slicer") is not None and inputs.get("pattern") in SHEET_PATTERNS

    @classmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> "SlicedSheet":
        """The sheet of these values."""
        pattern = _pattern(inputs)
        width = line_width_of(inputs)
        layer, lines = inputs.get("layer_height", LAYER_HEIGHT), inputs.get("fill_multiline", 1)
        _check(inputs, width, layer, lines)
        angle, one = _angle(inputs, pattern, along), line_of(inputs["slicer"], width, layer)
        spread = pattern.period * spread_lines(inputs["slicer"], lines) * one
        panel = SHEETS[pattern.sheet].cut(_is_turned(angle, along))
        cut = None if inputs.get("perimeters") else panel
        step = cut.step if cut else BLOCK
        follows = {"wall_thickness": lines * one, "line_width": width}

        def draft(period: float) -> SlicedSheet:
            sides = fitted(inputs, along, period, cut)
            if cut is None:
                _check_block(inputs, angle, one, sides)
            share = {"infill": spread / sides["period"]}
            return cls.model_validate(own_values(inputs, cls) | sides | follows | share)

        target, height = spread / inputs["infill"], pressed_height(inputs, along)
        lattice = checked(draft(target))
        if lattice.misfit:
            least, why = narrowest(lattice, draft, step)
            if isinf(least):
                raise _low(lattice, target, step)
            most = f"at most {at_most(in_unit(spread / least, '%'), 3)} %"
            raise RefusedError("lattice.infill", inputs["infill"], f"{most}, {why}")
        if target > widest(height, step):
            least = spread / widest(height, step)
            allowed = f"at least {at_least(in_unit(least, '%'), 3)} %"
            pressed = f"where {text_in(height, 'mm')} are pressed"
            raise RefusedError("lattice.infill", inputs["infill"], f"{allowed} {pressed}")
        return lattice

    @classmethod
    def sheet_clause(cls, inputs: Inputs) -> str:
        """Why walls of these values are a sheet."""
        return f'lattice.pattern is "{inputs["pattern"]}"'

    @classmethod
    def idle(cls, inputs: Inputs) -> dict[str, str]:
        """Sides of a block that would repeat."""
        clash = inputs.get("perimeters") and inputs.get("sides", "free") != "free"
        return {"sides": HELD} if clash else {}

    def inputs(self) -> dict[str, Any]:
        """The values from which this follows, for a block including all of its sides."""
        sides = {} if self.tied_sides else {side: self.value(side) for side in SIDES}
        return super().inputs() | sides

    def why_idle(self, key: str) -> str:
        """Why a key has no effect."""
        if key == "sides" and not self.tied_sides:
            return HELD
        why = super().why_idle(key)
        return f"lattice.perimeters is 0: {why}" if key in ("sides", *SIDES) else why

    @property
    def tied_sides(self) -> bool:
        """Whether its sides repeat, as it has no perimeters."""
        return self.perimeters == 0

    @property
    def outline(self) -> tuple[float, float]:
        """Thickness (m) of the perimeters at the sides, and at the bottom and top."""
        thickness = self.perimeters * self.wall_thickness / self.fill_multiline
        return thickness, thickness

    @property
    def sheet(self) -> str:
        """The name of the surface."""
        return PROGRAMS[self.slicer].sheets[self.pattern].sheet

    @property
    def turned(self) -> bool:
        """See `Surface`."""
        return _is_turned(self.fill_angle, self.pressed == ALONG)

    @property
    def extruded(self) -> float:
        """Volume as printed, m^3."""
        sheet = SHEETS[self.sheet].steep * super().extruded
        return sheet * self.inside + self.framed


def _pattern(inputs: Inputs) -> SheetPattern:
    """The pattern of the slicer; refuses patterns that it does not print."""
    slicer, name = inputs["slicer"], inputs["pattern"]
    if slicer not in PROGRAMS:
        raise RefusedError("lattice.slicer", slicer, ", ".join(PROGRAMS))
    program = PROGRAMS[slicer]
    if name not in program.sheets:
        other = next(other for other, program in PROGRAMS.items() if name in program.sheets)
        allowed = f'{names_in(slicer)}; "{name}" with lattice.slicer "{other}"'
        raise RefusedError("lattice.pattern", name, allowed)
    return program.sheets[name]


def _parallel(angle: float, other: float) -> bool:
    """Whether two angles (rad) differ by quarter turns."""
    return isclose(cos(4.0 * (angle - other)), 1.0)


def _is_turned(angle: float, along: bool) -> bool:
    """Whether a sheet is pressed between two of its axes, at a fill angle (rad)."""
    return not along and not _parallel(angle, FILL_ANGLE)


def _angle(inputs: Inputs, pattern: SheetPattern, along: bool) -> float:
    """The fill angle, rad; refuses an angle at which no period of the sheet fits the panel."""
    angle: float = inputs.get("fill_angle", FILL_ANGLE)
    if not pattern.turns and not isclose(angle, FILL_ANGLE):
        allowed = f"none: waves of {inputs['slicer']} lie along the sides of the part"
        raise RefusedError("lattice.fill_angle", angle, allowed)
    if not (along or any(_parallel(angle, other) for other in (0.0, FILL_ANGLE))):
        allowed = "0, 45 or 90 degrees, where it is pressed across the print axis"
        raise RefusedError("lattice.fill_angle", angle, allowed)
    return angle


def _check_block(inputs: Inputs, angle: float, line: float, sides: Mapping[str, Any]) -> None:
    """Refuse perimeters that leave no room, and waves across the corners of a block."""
    if not _parallel(angle, FILL_ANGLE):
        allowed = "45 degrees, or lattice.perimeters = 0: the waves of a block lie along its sides"
        raise RefusedError("lattice.fill_angle", angle, allowed)
    most = int(0.5 * min(sides["width"], sides["height"]) / line)
    if inputs["perimeters"] >= most:
        raise RefusedError("lattice.perimeters", inputs["perimeters"], f"0 to {most - 1}")


def _low(lattice: SlicedSheet, target: float, step: float) -> RefusedError:
    """The refusal of a height, or of a width, in which not even one step of the sheet fits."""
    if lattice.misfit != NARROW:
        return lattice.refusal("width", f"less, {lattice.misfit}")
    key = "depth" if lattice.pressed == ALONG else "height"
    least = step * max(lattice.wall_thickness / THICKEST, LEAST * target)
    return RefusedError(
        f"lattice.{key}", lattice.pressed_height, f"above {at_least(least)} m, {NARROW}"
    )


def _check(inputs: Inputs, width: float, layer: float, lines: int) -> None:
    """Refuse a share, a layer or lines that a slicer's sheet does not have; width, layer: m."""
    if "infill" not in inputs:
        raise RefusedError("lattice.infill", None, 'a share such as "15 %"')
    if inputs["infill"] < LEAST_SHARE:
        allowed = f"at least {text_in(LEAST_SHARE, '%')}"
        raise RefusedError("lattice.infill", inputs["infill"], allowed)
    check_layer(layer, width)
    if lines > PROGRAMS[inputs["slicer"]].lines:
        raise RefusedError(
            "lattice.fill_multiline", lines, '1; more with lattice.slicer "orca" or "cura"'
        )
