"""A lattice as a slicer lays it: lines in perimeters, in a pattern of the slicer's own name."""

from math import isnan, radians
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field

from sweep.config.kinds.mesh import nodes_of
from sweep.config.kinds.specimen import (
    LAYER_HEIGHT,
    MAX_NODES,
    NOZZLE,
    Lines,
    WallLattice,
    cause,
    check_proportion,
    check_size,
)
from sweep.config.kinds.table import (
    COMPUTED,
    Angle,
    Few,
    Inputs,
    Length,
    Mass,
    RefusedError,
    Share,
    own_values,
    similar,
)
from sweep.design.geometry import Geometry
from sweep.design.slicer.patterns import (
    NO_PRISMS,
    OVERLAP,
    PATTERNS,
    PROGRAMS,
    SLICERS,
    InfillLines,
    Pattern,
    bare,
    distance_of,
    line_of,
    lines_at_most,
    share_of,
    spread_lines,
)
from sweep.numbers import at_least, at_most, in_unit

FILL_ANGLE, PERIMETERS = radians(45.0), 2
ALONG_DEPTH = 0.0  # fill angle of lateral patterns, rad
MOST_LINES = max(program.lines for program in PROGRAMS.values())  # side by side in a wall
MASS_ERROR = 0.06  # of a drawing: filament of 1.75 mm, ± 0.05 mm, is as much heavier or lighter
NEAR = 0.1  # shares tried instead of one that cannot be drawn
SIZES = ("infill", "line_distance", "mass")  # keys, one of which sets how far apart the lines are
UNKNOWN = {"infill": 0.5, "fill_distance": 1.0, "cells_x": 1, "cells_y": 1}  # until it is computed


class Sliced(WallLattice):
    """An infill with the `pattern` of a slicer, within `perimeters`, layers stacked along `depth`.

    Of a lateral pattern, whose lines run along the depth, layers are stacked along the height, and
    there are solid ones at the bottom and top, about as thick as the perimeters.

    `infill`, the `line_distance` of parallel walls, or the `mass` as extruded, sets
    `fill_distance`, and about how many cells fit. `fill_multiline`: number of lines in each wall.
    line_width: of a line with the mean thickness `line`; `wall_thickness` is a multiple of `line`.
    """

    because: ClassVar[str] = "lattice.slicer is given"
    labels: ClassVar[tuple[str, ...]] = (*WallLattice.labels, "line_distance")
    constants: ClassVar[dict[str, Any]] = {"kind": "square"}
    aperiodic: ClassVar[str] = (
        " has parallel lines, which only perimeters join: without end they hold nothing together"
    )
    derived: ClassVar[tuple[str, ...]] = ("fill_distance", "cells_x", "cells_y", "wall_thickness")
    sets: ClassVar[dict[str, tuple[str, ...]]] = {
        "infill": ("fill_distance",),
        "mass": ("infill", "fill_distance"),
        "line_distance": ("infill", "fill_distance"),
    }
    replaces: ClassVar[dict[str, tuple[str, ...]]] = dict.fromkeys(
        ("wall_thickness", "cells_x", "cells_y"), SIZES
    )

    slicer: Literal["prusa", "orca", "cura"]
    pattern: str
    infill: Share
    line_distance: Length | None = None
    mass: Mass | None = None
    fill_angle: Angle = FILL_ANGLE
    fill_distance: Annotated[Length, COMPUTED]
    fill_multiline: Annotated[int, Field(ge=1, le=MOST_LINES)] = 1
    line_width: Length
    layer_height: Length = LAYER_HEIGHT
    perimeters: Lines = 0
    cells_x: Few
    cells_y: Few

    @classmethod
    def means(cls, inputs: Inputs) -> bool:
        """Whether values mean this kind of lattice."""
        return inputs.get("slicer") is not None

    @classmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> Self:
        """The infill of these values."""
        pattern = _checked_pattern(inputs)
        width = line_width_of(inputs)
        usual = {
            "perimeters": PERIMETERS,
            "nodes_per_wall": nodes_of(PATTERNS[pattern].family),
            "fill_angle": ALONG_DEPTH if PATTERNS[pattern].slopes else FILL_ANGLE,
        }
        lattice = cls.model_validate(
            usual | own_values(inputs, cls) | UNKNOWN | {"line_width": width}
        )
        check_proportion(lattice)
        _check_lines(lattice)
        lattice = lattice.model_copy(
            update={"wall_thickness": lattice.printed_as.wall * lattice.lines}
        )
        share = _share(lattice, inputs, density)
        return lattice.model_copy(update=_spacing_of(lattice, share, density))

    def inputs(self) -> dict[str, Any]:
        """The values from which this follows, without the share if it follows from another
        value.
        """
        values, follows = super().inputs(), (self.mass, self.line_distance) != (None, None)
        return {k: v for k, v in values.items() if k != "infill"} if follows else values

    def implies(self, key: str, value: object) -> bool:
        """As `Table.implies`; solid layers follow from the perimeters."""
        return value == self.solid_layers if key == "solid_layers" else super().implies(key, value)

    @property
    def printed_as(self) -> Pattern:
        """The pattern."""
        return PATTERNS[self._pattern]

    @property
    def lateral(self) -> bool:
        """Whether its layers are stacked along the height."""
        return bool(self.printed_as.slopes)

    @property
    def _pattern(self) -> str:
        return SLICERS[self.slicer][self.pattern]

    @property
    def line(self) -> float:
        """Mean thickness of one line, m."""
        return line_of(self.slicer, self.line_width, self.layer_height)

    @property
    def lines(self) -> float:
        """Thickness of the lines of one wall of the infill, side by side (m)."""
        return self.fill_multiline * self.line

    @property
    def spread_line(self) -> float:
        """Mean thickness (m) of a wall as a share of infill counts it: the share is n times this
        over the distance of parallel walls.
        """
        return spread_lines(self.slicer, self.fill_multiline) * self.line

    @property
    def gap_printed(self) -> float:
        """Clear width of the narrowest cell, m; beside the double walls of a honeycomb."""
        return self.opening - (2.0 if self.printed_as.wall > 1.0 else 1.0) * self.lines

    def thicker(self, times: float) -> dict[str, Any]:
        """The changes if wider lines are laid in the same places, including perimeters."""
        wider = self.line_width + (times - 1.0) * self.line
        return {"line_width": wider, "infill": times * self.infill}

    def check_standing(self, where: str) -> None:
        """Refuse every lattice, as lines cannot be pressed along the cells."""
        raise self.refusal("slicer", f"none {where}: give kind and cells")

    @property
    def outline(self) -> tuple[float, float]:
        """Thickness (m) of the outline: at the left and right sides, at the bottom and top."""
        sides = self.perimeters * self.line
        return sides, self.solid_layers * self.layer_height if self.lateral else sides

    @property
    def solid_layers(self) -> int:
        """Number of solid layers at the bottom and top."""
        return max(1, round(self.perimeters * self.line / self.layer_height)) if self.lateral else 0

    @property
    def geometry(self) -> Geometry:
        """The numbers that define the drawing."""
        sides, caps = self.outline
        overlaps = OVERLAP * self.line, 0.0 if self.lateral else OVERLAP * self.line
        inset = 0.5 * sides - overlaps[0], 0.5 * caps - overlaps[1]
        lines = InfillLines(self._pattern, self.fill_distance, self.fill_angle, self.lines, inset)
        return Geometry(
            "square",
            None,
            (self.cells_x, self.cells_y),
            (self.width, self.height),
            self.wall_thickness,
            outline=self.outline,
            sliced=lines,
        )

    @property
    def opening(self) -> float:
        """Clear width of the narrowest whole cell between centre lines, m."""
        return self.printed_as.opening * self.fill_distance


def line_width_of(inputs: Inputs) -> float:
    """The width of a line (m): as given, or the slicer's default for the nozzle."""
    usual = PROGRAMS[inputs["slicer"]].nozzles * inputs.get("nozzle", NOZZLE)
    return float(inputs.get("line_width", usual))


def check_layer(layer: float, width: float) -> None:
    """Refuse a line that is higher than wide, m."""
    if layer > width:
        raise RefusedError("lattice.layer_height", layer, f"at most the line width, {width:g} m")


def _share(lattice: Sliced, inputs: Inputs, density: float) -> float:
    """The share of infill, as given, or from the distance of lines, or from the mass."""
    ways = [key for key in SIZES if inputs.get(key) is not None]
    if len(ways) > 1:
        allowed = f"none where lattice.{ways[0]} is given"
        raise RefusedError(f"lattice.{ways[1]}", inputs[ways[1]], allowed)
    if lattice.line_distance is not None:
        share = share_of(lattice._pattern, lattice.line_distance, lattice.spread_line)
        if share < 1.0:
            return share
        raise lattice.refusal("line_distance", f"above {at_least(share * lattice.line_distance)} m")
    return inputs["infill"] if lattice.mass is None else _share_for(lattice, lattice.mass, density)


def _spacing_of(lattice: Sliced, share: float, density: float) -> dict[str, Any]:
    """The values that a share of infill sets."""
    most = _most_of(lattice)
    if share >= most * (1.0 - 1e-12):
        wide = "so that cells are twice as wide as their walls"
        if lattice.line_distance is not None:
            least = distance_of(lattice._pattern, most, lattice.spread_line)
            raise lattice.refusal("line_distance", f"above {at_least(least)} m, {wide}")
        allowed = f"below {at_most(in_unit(most, '%'), 3)} %, {wide}"
        raise RefusedError("lattice.infill", share, allowed)
    spacing = _spacing(lattice, share)
    candidate = lattice.model_copy(update=spacing)
    check_size(candidate, candidate.inputs(), SIZES)
    if abs(_mass_ratio(candidate) - 1.0) > MASS_ERROR:
        raise _refused_drawing(candidate, share, density)
    return spacing


def _most_of(lattice: Sliced) -> float:
    """The share at which the narrowest cell is twice as wide as its walls."""
    return lattice.printed_as.most * lattice.spread_line / lattice.lines


def _mass_ratio(candidate: Sliced) -> float:
    """The mass of the walls as drawn over the mass that is extruded."""
    from sweep.design.slicer.network import drawn_over_extruded

    return drawn_over_extruded(candidate.network, candidate.geometry)


def _refused_drawing(candidate: Sliced, share: float, density: float) -> RefusedError:
    """Why a share cannot be drawn, and the nearest whole per cent within `NEAR` that can."""
    wrong = 100.0 * (_mass_ratio(candidate) - 1.0)
    weight = f"{abs(wrong):.0f} % {'more' if wrong > 0.0 else 'less'} than is extruded"
    why = f"lines that run too near the perimeters make the walls weigh {weight}"
    near = [percent / 100.0 for percent in range(1, 100) if abs(percent / 100.0 - share) < NEAR]
    for other in sorted(near, key=lambda other: abs(other - share)):
        nearest = candidate.model_copy(update=_spacing(candidate, other))
        if other < _most_of(candidate) and abs(_mass_ratio(nearest) - 1.0) <= MASS_ERROR:
            mass, turn = density * nearest.counted_volume, ", or another fill_angle"
            examples = {
                "line_distance": f"{nearest.fill_distance:.4g} m, for example{turn}",
                "mass": f"{mass:.4g} kg, for example",
                "infill": f"{100.0 * other:.0f} %, for example{turn}",
            }
            key = next(key for key in examples if getattr(candidate, key) is not None)
            return candidate.refusal(key, f"{examples[key]}; {why}")
    allowed = (
        f"another number, or a larger box; {why}, as with any infill near {100.0 * share:.0f} %"
    )
    return candidate.refusal("perimeters", allowed)


def _spacing(lattice: Sliced, share: float) -> dict[str, Any]:
    """The distance of lines at a share, and about how many cells fit."""
    distance = distance_of(lattice._pattern, share, lattice.spread_line)
    columns, rows = (max(1, round(size / distance)) for size in (lattice.width, lattice.height))
    if columns * rows > MAX_NODES:
        allowed = f"a share whose lines make at most {MAX_NODES:,} cells in this box"
        raise RefusedError(*cause(lattice, lattice.inputs(), SIZES), allowed)
    return {"infill": share, "fill_distance": distance, "cells_x": columns, "cells_y": rows}


def _share_for(lattice: Sliced, mass: float, density: float) -> float:
    """The share with which a mass (kg) is extruded."""
    from sweep.design.slicer.network import LEAST_SHARE, share_for

    first = lattice.model_copy(update=_spacing(lattice, LEAST_SHARE))
    counted = lattice.spread_line / lattice.lines  # share as the slicer counts / as extruded
    most = (1.0 - 1e-9) * _most_of(lattice) / counted
    per_area = density * lattice.depth
    share, *limits = share_for(first.geometry, mass / per_area, most)
    if isnan(share):
        light, heavy = (per_area * area for area in limits)
        bounds = f"between {at_least(light)} kg and {at_most(heavy)} kg"
        allowed = f"{bounds} as extruded with this pattern"
        if light < mass < heavy:
            allowed = "another mass: there a line along a side appears; or another fill_angle"
        raise RefusedError("lattice.mass", mass, allowed)
    return counted * share


def _checked_pattern(inputs: Inputs) -> str:
    """The pattern, by its name in `PATTERNS`; patterns that are no prisms are refused."""
    if inputs["slicer"] not in SLICERS:
        raise RefusedError("lattice.slicer", inputs["slicer"], ", ".join(SLICERS))
    patterns, pattern = SLICERS[inputs["slicer"]], inputs.get("pattern")
    key, names = "lattice.pattern", names_in(inputs["slicer"])
    if pattern is None:
        raise RefusedError(key, None, f"{names}, as lattice.slicer is given")
    if pattern not in patterns:
        near = _no_prism(pattern, patterns) or similar(pattern, names.split('"')[1::2])
        raise RefusedError(key, pattern, f"{names}{near}")
    if all(inputs.get(key) is None for key in SIZES):
        allowed = 'a share such as "20 %", a lattice.line_distance, or a lattice.mass'
        raise RefusedError("lattice.infill", None, allowed)
    count = inputs.get("fill_multiline", 1)
    if count > lines_at_most(inputs["slicer"], patterns[pattern]):
        other = "a pattern other than honeycomb and the lateral ones"
        allowed = f'1; more with lattice.slicer "orca" or "cura" and {other}'
        raise RefusedError("lattice.fill_multiline", count, allowed)
    return patterns[pattern]


def names_in(slicer: str) -> str:
    """The patterns of a slicer that can be computed, in its own words."""
    program = PROGRAMS[slicer]
    return ", ".join(f'"{name}"' for name in (*program.patterns, *program.sheets))


def _no_prism(pattern: str, patterns: dict[str, str]) -> str:
    """Why a pattern is no prism, and the nearest that is; of the pattern of another slicer its name
    in this one, or which one has it; else empty.
    """
    for other, program in PROGRAMS.items():
        if pattern in program.patterns:
            same = [own for own, name in patterns.items() if name == program.patterns[pattern]]
            elsewhere = f'"{pattern}" with lattice.slicer "{other}"'
            return f'; here it is "{same[0]}"' if same else f"; {elsewhere}"
    why, nearest = NO_PRISMS.get(bare(pattern), ("", "grid"))
    nearest = next((own for own, name in patterns.items() if name == nearest), "grid")
    return f"; {pattern} is no prism, as {why}: the nearest is {nearest}" if why else ""


def _check_lines(lattice: Sliced) -> None:
    """Refuse lines that are higher than wide or turned out of the drawing, and perimeters that are
    absent or leave no room.
    """
    check_layer(lattice.layer_height, lattice.line_width)
    if lattice.lateral and lattice.fill_angle != ALONG_DEPTH:
        allowed = f"0 degrees: lines of {lattice.pattern} run along lattice.depth"
        raise lattice.refusal("fill_angle", allowed)
    most = int(0.5 * min(lattice.width, lattice.height) / lattice.line)
    if not 1 <= lattice.perimeters < most:
        allowed = f"1 to {most - 1}, as lattice.slicer is given: perimeters hold the infill"
        raise lattice.refusal("perimeters", allowed)
