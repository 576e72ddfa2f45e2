"""The table `lattice`: the specimen, and the values that follow from other keys."""

from math import isclose, isnan, radians
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import AfterValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from sweep.config.lattice_limits import (
    CUSTOM,
    MAX_NODES,
    check_openings,
    check_period,
    check_proportion,
)
from sweep.config.slicer_lines import check_lines, check_pattern, spacing_of, with_mass
from sweep.config.structures.structure import Structure
from sweep.config.structures.structure_file import faults, read_structure
from sweep.config.tables import Few, Length, Mass, Size, Table, refusal
from sweep.constants import MM, TO_MM
from sweep.design.geometry import Geometry
from sweep.design.infill import families, trait
from sweep.design.slicer.patterns import (
    OVERLAP,
    PATTERNS,
    PROGRAMS,
    SLICERS,
    Pattern,
    Sliced,
    line_of,
)

NOZZLE, LAYER_HEIGHT = 0.4e-3, 0.2e-3  # m
FILL_ANGLE, PERIMETERS = radians(45.0), 2  # of a slicer
MOST_LINES = 10  # that OrcaSlicer lays side by side


def _known(kind: str) -> str:
    if kind not in (*families(), CUSTOM):
        raise PydanticCustomError("literal_error", "no family of infill")
    return kind


Kind = Annotated[
    str, AfterValidator(_known), Field(json_schema_extra={"enum": list[Any]([*families(), CUSTOM])})
]
Lines = Annotated[int, Field(ge=0, le=100)]
Share = Annotated[float, Field(gt=0, lt=1, json_schema_extra={"unit": "1"})]
Angle = Annotated[float, Field(json_schema_extra={"unit": "rad"})]


class Lattice(Table):
    """The specimen: outer size over centre lines, infill, outline, mesh of the walls.

    None: not used, or filled in. `infill` replaces the cells and `wall_thickness`: the share of the
    box that lines of `line_width` fill, as slicers count. `mass` replaces `wall_thickness`, which
    `sized` computes. A lattice of kind "custom" is the `structure` in `file`, which is connected;
    box and thickness are measured from it; a given `wall_thickness` scales all of its walls, so
    that it is their mean.
    slicer: the infill is laid as this slicer lays it, in a `pattern` of the slicer's own name,
    within `perimeters`, with `fill_multiline` lines in each wall; layers are stacked along `depth`.
    `infill`, or the `mass` as extruded, then sets `fill_distance`, that of parallel walls.
    printable: what does not print is refused, by lines of `line_width`, or as wide as the `nozzle`
    where lines are not used otherwise.
    layers: quads up the height of a lattice that is pressed along its depth; None: as high as they
    are long. symmetry "quarter": such a lattice is cut at its two mirror planes. imperfection_seed:
    of the shape of its imperfection; None: the shape in which equal walls buckle.
    boundary "periodic": one period of an endless lattice, of size `width` x `height`. Opposite
    sides are tied to each other; the mean shear strain and the mean lateral stress are zero.
    """

    neutral: ClassVar[dict[str, Any]] = {
        "boundary": "free",
        "grading": 1.0,
        "perimeters": 0,
        "solid_layers": 0,
        "symmetry": "none",
        "fill_multiline": 1,
    }
    labels: ClassVar[tuple[str, ...]] = ("infill", "mass", "file", "nozzle", "printable")

    kind: Kind = "square"
    file: str | None = None
    structure: Structure | None = None
    orientation: Literal["pointy", "flat"] | None = None
    boundary: Literal["free", "periodic"] = "free"
    cells_x: Few = 3
    cells_y: Few = 3
    width: Size = 12.5e-3
    height: Size = 12.5e-3
    depth: Size = 12e-3
    wall_thickness: Length = 0.8e-3
    mass: Mass | None = None
    infill: Share | None = None
    slicer: Literal["prusa", "orca", "cura"] | None = None
    pattern: str | None = None
    fill_angle: Angle | None = None
    fill_distance: Length | None = None
    fill_multiline: Annotated[int, Field(ge=1, le=MOST_LINES)] = 1
    nozzle: Length = NOZZLE
    printable: bool = False
    grading: Annotated[float, Field(gt=0)] = 1.0
    perimeters: Lines = 0
    line_width: Length | None = None
    solid_layers: Lines = 0
    layer_height: Length | None = None
    nodes_per_wall: Annotated[int, Field(ge=0, le=1000)] = 2
    imperfection: Annotated[
        float, Field(ge=0, le=100, json_schema_extra={"unit": "1", "bare": True})
    ] = 0.01
    imperfection_seed: Annotated[int, Field(ge=0)] | None = None
    layers: Few | None = None
    symmetry: Literal["none", "quarter"] = "none"

    @model_validator(mode="before")
    @classmethod
    def _read(cls, given: Any) -> Any:
        if not isinstance(given, dict) or given.get("kind") != CUSTOM or "structure" in given:
            return given
        if given.get("file") is None:
            raise refusal("lattice.file", None, "the path of a .json file, as the kind is custom")
        structure = read_structure(Path(given["file"]))
        if (thickness := given.get("wall_thickness")) is not None:
            structure = _scaled(structure, thickness)
        return {**given, "structure": structure}

    @model_validator(mode="after")
    def _complete(self) -> Self:
        if self.boundary == "periodic":
            check_period(self)
        if self.structure is not None:
            return self._measured(self.structure)
        check_proportion(self)
        if self.slicer is not None:
            return self._cut(SLICERS[self.slicer])
        if self.fill_multiline != 1:
            raise refusal("lattice.fill_multiline", self.fill_multiline, "1 without lattice.slicer")
        lines = self.perimeters > 0 or self.infill is not None
        used = {
            "file": None,
            "orientation": (self.orientation or "pointy") if trait(self.kind, "ORIENTED") else None,
            "pattern": None,
            "fill_angle": None,
            "fill_distance": None,
            "line_width": (self.line_width or self.nozzle) if lines else None,
            "layer_height": (self.layer_height or LAYER_HEIGHT) if self.solid_layers else None,
        }
        self._set(used)
        if self.infill is not None:
            self._fill(self.infill)
        self.check_size()
        if self.mass is None or "wall_thickness" in self.model_fields_set:
            check_openings(self)
        return self

    def _measured(self, structure: Structure) -> Self:
        """The table with the box, the mean thickness and the depth of a structure, in m."""
        width, height = structure.size_mm
        thickness = structure.thickness_mm
        measures = {
            "file": Path(self.file).name if self.file else None,
            "cells_x": 1,
            "cells_y": 1,
            "width": MM * width,
            "height": MM * height,
            "depth": MM * structure.depth_mm,
            "wall_thickness": MM * sum(thickness) / len(thickness),
            "nodes_per_wall": 0,
        }
        self._set(measures)
        return self

    def _cut(self, patterns: dict[str, str]) -> Self:
        """The table of a lattice that a slicer fills; ``patterns``: those that it prints."""
        check_pattern(self, patterns)
        width = self.nozzle * PROGRAMS[self.slicer or ""].nozzles
        given = self.model_fields_set
        used = {
            "file": None,
            "line_width": self.line_width or width,
            "layer_height": self.layer_height or LAYER_HEIGHT,
            "fill_angle": FILL_ANGLE if self.fill_angle is None else self.fill_angle,
            "perimeters": self.perimeters if "perimeters" in given else PERIMETERS,
        }
        self._set(used)
        check_lines(self)
        thickness = self.printed_as.wall * self.lines
        self._follow("wall_thickness", thickness, f"{thickness:g} m, as lattice.slicer is given")
        if self.infill is not None:
            if self.mass is not None:
                raise refusal("lattice.mass", self.mass, "none where lattice.infill is given")
            self._set(spacing_of(self, self.infill))
            self.check_size()
            check_openings(self)
        return self

    def _set(self, values: dict[str, Any]) -> None:
        for key, value in values.items():
            object.__setattr__(self, key, value)  # the model is frozen

    def _fill(self, share: float) -> None:
        """Fill in the cells and the wall thickness of a share of infill."""
        if self.mass is not None:
            raise refusal("lattice.mass", self.mass, "none where lattice.infill is given")
        wished = f"as lattice.infill is {100 * share:g} %; give one of them"
        self._follow("wall_thickness", self.line_width, f"{self.line_width:g} m, {wished}")
        from sweep.design.sizing import cells_for

        cells = cells_for(self.geometry, share, MAX_NODES)
        if cells is None:
            allowed = f"a share that 1 to {MAX_NODES:,} cells fill with lines of "
            raise refusal("lattice.infill", share, f"{allowed}{self.line_width:g} m in this box")
        for key, value in zip(("cells_x", "cells_y"), cells, strict=True):
            self._follow(key, value, f"{value}, {wished}")

    def _follow(self, key: str, value: Any, allowed: str) -> None:
        """Fill in a value that follows from other keys; refuse a different given value."""
        if key in self.model_fields_set and getattr(self, key) != value:
            raise refusal(f"lattice.{key}", getattr(self, key), allowed)
        object.__setattr__(self, key, value)

    def check_size(self) -> None:
        """Refuse a lattice of more than `MAX_NODES` nodes."""
        joints, walls = self._counts
        nodes = joints + walls * self.nodes_per_wall
        if nodes > MAX_NODES:
            values = {key: getattr(self, key) for key in ("cells_x", "cells_y", "nodes_per_wall")}
            key = max(values, key=values.__getitem__)
            if self.infill is not None:
                key, values = "infill", {"infill": self.infill}
            allowed = f"at most {MAX_NODES:,} nodes in all, {nodes:,} here"
            raise refusal(f"lattice.{key}", values[key], allowed)

    @property
    def geometry(self) -> Geometry:
        """The numbers that define the drawing of a lattice that is no custom structure."""
        return Geometry(
            self.kind,
            self.orientation,
            (self.cells_x, self.cells_y),
            (self.width, self.height),
            self.wall_thickness,
            self.grading,
            self.outline,
            self.boundary == "periodic",
            self._lines,
        )

    @property
    def printed_as(self) -> Pattern:
        """The pattern of a lattice with a slicer."""
        return PATTERNS[SLICERS[self.slicer or "prusa"][self.pattern or ""]]

    @property
    def line(self) -> float:
        """What one line fills (m); without a slicer its width."""
        width = self.line_width or self.nozzle
        if self.slicer is None:
            return width
        return line_of(self.slicer, width, self.layer_height or LAYER_HEIGHT)

    @property
    def lines(self) -> float:
        """What the lines of one wall of the infill fill, side by side (m)."""
        return self.fill_multiline * self.line

    @property
    def _lines(self) -> Sliced | None:
        if self.slicer is None or self.fill_distance is None:
            return None
        return Sliced(
            SLICERS[self.slicer][self.pattern or ""],
            self.fill_distance,
            self.fill_angle or 0.0,
            self.lines,
            (0.5 * self.perimeters - OVERLAP) * self.line,
        )

    @property
    def walls(self) -> int:
        """Number of walls between joints."""
        return self._counts[1]

    @property
    def _counts(self) -> tuple[int, int]:
        """Numbers of joints and walls; of a custom structure, of nodes and elements."""
        if self.structure is not None:
            return len(self.structure.nodes_mm), sum(self.structure.pieces)
        if self.slicer is not None:
            from sweep.design.lattice import build_network

            network = build_network(self.geometry)
            return len(network.points), len(network.walls)
        if known := trait(self.kind, "counts"):
            return known(self.cells_x, self.cells_y)
        from sweep.design.drawing import counts, sketch

        return counts(sketch(self.geometry))

    @property
    def opening(self) -> float:
        """Clear width of the narrowest whole cell between centre lines, m."""
        if self.slicer is not None:
            return self.printed_as.opening * (self.fill_distance or 0.0)
        if known := trait(self.kind, "opening"):
            return known(self.width / self.cells_x, self.height / self.cells_y)
        from sweep.design.box import opening

        return opening(self.geometry)

    @property
    def thickest(self) -> float:
        """Wall thickness (m) at which the narrowest opening is as wide as its walls are thick."""
        if self.grading == 1.0:
            return 0.5 * self.opening
        from sweep.design.box import gradient

        return 0.5 * self.opening / float(gradient(self.geometry).max())

    @property
    def outline(self) -> tuple[float, float]:
        """Thickness (m) of the outline: at the left and right sides, at the bottom and top."""
        sides = self.perimeters * self.line if self.perimeters else 0.0
        return sides, self.solid_layers * (self.layer_height or 0.0) or sides

    @property
    def outer_size(self) -> tuple[float, float]:
        """Width and height over all (m), with walls of mean thickness where there is no outline.

        For an endless lattice, the size of the period.
        """
        if self.boundary == "periodic":
            return self.width, self.height
        sides, caps = (outline or self.wall_thickness for outline in self.outline)
        return self.width + sides, self.height + caps


def _scaled(structure: Structure, thickness: float) -> Structure:
    """A structure whose walls are as thick on average as `thickness` (m)."""
    if not thickness > 0.0:
        return structure  # refused as a value of its key
    made = structure.with_thickness(float(f"{TO_MM * thickness:.15g}"))
    if wrong := next(faults(made), None):
        raise refusal("lattice.wall_thickness", thickness, f"one that fits the structure ({wrong})")
    return made


def sized(lattice: Lattice, density: float) -> Lattice:
    """The lattice with the wall thickness that gives its `mass`; `density` in kg/m^3."""
    if lattice.mass is None or lattice.structure is not None:
        return lattice
    if lattice.slicer is not None:
        return with_mass(lattice, density)
    from sweep.design.sizing import thickness_for

    thickness, light, heavy = thickness_for(
        lattice.geometry, lattice.mass, lattice.thickest, lattice.depth, density
    )
    if isnan(thickness):
        allowed = f"between {light:.4g} kg and {heavy:.4g} kg with these cells"
        raise refusal("lattice.mass", lattice.mass, allowed)
    given = "wall_thickness" in lattice.model_fields_set
    if given and not isclose(lattice.wall_thickness, thickness, rel_tol=1e-9):
        allowed = f"{thickness:.6g} m at the mass given; give one of them"
        raise refusal("lattice.wall_thickness", lattice.wall_thickness, allowed)
    made = lattice.model_copy(update={"wall_thickness": thickness})
    check_openings(made)
    return made
