"""The common part of all specimens: a box over centre lines, walls, a mesh and an imperfection."""

from abc import abstractmethod
from math import isclose, isnan
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

from pydantic import Field

from sweep.config.kinds.table import Few, Inputs, Length, RefusedError, Size, Table
from sweep.config.structures.structure import Structure
from sweep.design.geometry import THIN, Geometry
from sweep.numbers import at_least, at_most

if TYPE_CHECKING:
    from sweep.design.network import Network

NOZZLE, LAYER_HEIGHT = 0.4e-3, 0.2e-3  # m
# 54,681 nodes (40 x 40 triangles) take up to 7.6 GB, and 46 minutes.
MAX_NODES = 60_000
ENDLESS = 'if lattice.boundary is "periodic"'
TIED = 'if lattice.sides is "periodic"'
MOST_IMPERFECTION = 1.0  # largest imperfection of shells, in wall thicknesses
MAX_ASPECT = 1000.0  # aspect ratio of the box above which the computed areas lose their accuracy

Lines = Annotated[int, Field(ge=0, le=100)]
Nodes = Annotated[int, Field(ge=0, le=1000)]
Imperfection = Annotated[float, Field(ge=0, le=100, json_schema_extra={"unit": "1", "bare": True})]


class Specimen(Table):
    """A specimen: its outer size over centre lines, and the mesh of its walls.

    nozzle: width of a line if no line width is given. printable: refuse walls and gaps that do not
    print. layers: quads up the height of a lattice that is pressed along its cells; None across
    them. symmetry "quarter": such a lattice is cut at its two mirror planes. imperfection_seed: of
    the shape of its imperfection; None: the shape in which equal walls buckle.

    words: allowed values of `lattice.kind`. across: keys without effect when it is pressed across
    its cells, with their values there. aperiodic: why no period of it is known, after its name.
    """

    table: ClassVar[str] = "lattice"
    words: ClassVar[tuple[str, ...]] = ()
    across: ClassVar[dict[str, Any]] = {
        "layers": None,
        "symmetry": "none",
        "imperfection_seed": None,
    }
    aperiodic: ClassVar[str]

    labels: ClassVar[tuple[str, ...]] = ("infill", "mass", "file", "nozzle", "printable")
    neutral: ClassVar[dict[str, Any]] = {
        "boundary": "free",
        "sides": "free",
        "grading": 1.0,
        "perimeters": 0,
        "solid_layers": 0,
        "symmetry": "none",
        "fill_multiline": 1,
    }

    width: Size = 12.5e-3
    height: Size = 12.5e-3
    depth: Size = 12e-3
    wall_thickness: Length = 0.8e-3
    nozzle: Length = NOZZLE
    printable: bool = False
    imperfection: Imperfection = 0.01
    imperfection_seed: Annotated[int, Field(ge=0)] | None = None
    layers: Few | None = None
    symmetry: Literal["none", "quarter"] = "none"

    @classmethod
    def means(cls, inputs: Inputs) -> bool:
        """Whether values mean this kind of lattice."""
        return inputs.get("kind") in cls.words

    @classmethod
    @abstractmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> Self:
        """The lattice of these values; density (kg/m^3): of the material. along: whether it is
        pressed along its cells.
        """

    @classmethod
    def idle(cls, inputs: Inputs) -> dict[str, str]:
        """The given keys that this kind never has, each with the reason, for the message that
        refuses it.
        """
        return {}

    @classmethod
    def sheet_clause(cls, inputs: Inputs) -> str:
        """Why walls of these values are a sheet; empty if they are none."""
        return ""

    @property
    def name(self) -> str:
        """Its name for people: the slicer's own name of its pattern, or its kind."""
        return str(self.value("pattern") or self.value("kind"))

    @property
    def loaded(self) -> Structure | None:
        """The structure, if its file has the loads too."""
        structure: Structure | None = self.value("structure")
        return structure

    @property
    def network(self) -> "Network":
        """Centre lines and thickness of the walls, m."""
        raise TypeError(f"{self.name} is not drawn with lines")

    @property
    @abstractmethod
    def counted_volume(self) -> float:
        """Volume of the walls as budgets count it, m^3."""

    @property
    def pieces(self) -> tuple[int, ...]:
        """Number of elements: of every wall, or of each one."""
        return (self.value("nodes_per_wall") + 1,)

    def remeshed(self, pieces: tuple[int, ...]) -> dict[str, Any]:
        """The changes for other numbers of `pieces`."""
        return {"nodes_per_wall": pieces[0] - 1}

    @property
    def wall_quads(self) -> Any:
        """Number of quads along a whole upright wall: (1,) for all walls, or (w,)."""
        return self.pieces

    def check_standing(self, where: str) -> None:
        """Refuse walls that cannot be pressed along the cells; where: why they are, in words."""

    @property
    def line_printed(self) -> float:
        """Width of a line, m."""
        return float(self.value("line_width") or self.nozzle)

    @property
    def walls_printed(self) -> tuple[float, ...]:
        """Thicknesses of walls that have to be whole numbers of lines, m; not of a slicer's."""
        return () if self.value("slicer") else (self.wall_thickness,)

    @property
    def gap_printed(self) -> float | None:
        """Clear width of the narrowest cell, m; None if it is not known."""
        return None

    @property
    def endless(self) -> bool:
        """Whether this is one period of an endless lattice."""
        return bool(self.value("boundary") == "periodic")

    @property
    def tied_sides(self) -> bool:
        """Whether its left and right sides are tied to each other."""
        return bool(self.value("sides") == "periodic")

    @property
    def sheet(self) -> str:
        """The name of the surface that it is; empty if it is drawn with lines."""
        return ""

    @property
    def outline(self) -> tuple[float, float]:
        """Thickness (m) of the outline: at the left and right sides, at the bottom and top."""
        return 0.0, 0.0

    @property
    def outer_size(self) -> tuple[float, float]:
        """Overall width and height (m), with walls of mean thickness if there is no outline."""
        sides, caps = (outline or self.wall_thickness for outline in self.outline)
        return self.width + sides, self.height + caps


class WallLattice(Specimen):
    """A specimen whose walls follow from a few numbers, its `geometry`."""

    nodes_per_wall: Nodes

    @property
    def network(self) -> "Network":
        """Centre lines and thickness of the walls, m."""
        from sweep.design.lattice import build_network

        return build_network(self.geometry)

    @property
    def counted_volume(self) -> float:
        """Volume of the walls as budgets count it, m^3."""
        from sweep.design.lattice import counted_area

        return self.depth * counted_area(self.geometry)

    @property
    def gap_printed(self) -> float | None:
        """Clear width of the narrowest cell, m."""
        return self.opening - max(self.walls_printed)

    def thicker(self, times: float) -> dict[str, Any]:
        """The changes if walls are laid ``times`` as thick in the same places."""
        return {"wall_thickness": times * self.wall_thickness}

    @property
    @abstractmethod
    def geometry(self) -> Geometry:
        """The numbers that define the drawing."""

    @property
    @abstractmethod
    def opening(self) -> float:
        """Clear width of the narrowest whole cell between centre lines, m."""

    @property
    def thickest(self) -> float:
        """Wall thickness (m) at which the narrowest opening is as wide as its walls are thick."""
        return 0.5 * self.opening

    @property
    def counts(self) -> tuple[int, int]:
        """Numbers of joints and of walls between joints."""
        from sweep.design.drawing import counts, sketch

        geometry = self.geometry
        if geometry.drawing is not None:
            return len(geometry.drawing.joints), len(geometry.drawing.walls)
        if geometry.sliced is not None:
            return len(self.network.points), len(self.network.walls)
        return counts(sketch(geometry))

    @property
    def elements(self) -> int:
        """Number of elements of all walls."""
        return self.counts[1] * (self.nodes_per_wall + 1)


def pressed_height(inputs: Inputs, along: bool) -> float:
    """The height (m) that these values of a lattice press."""
    key = "depth" if along else "height"
    height: float = inputs.get(key, Specimen.model_fields[key].default)
    return height


def check_proportion(specimen: Specimen) -> None:
    """Refuse a box whose aspect ratio is too large."""
    key, other = "width", "height"
    if "width" not in specimen.model_fields_set:
        key, other = other, key
    value, side = getattr(specimen, key), getattr(specimen, other)
    least, most = side / MAX_ASPECT, side * MAX_ASPECT
    if not least <= value <= most:
        allowed = f"from {least:g} m to {most:g} m, a thousandth to a thousand times the {other}"
        raise RefusedError(f"lattice.{key}", value, allowed)


def check_size(specimen: WallLattice, inputs: Inputs, causes: tuple[str, ...]) -> None:
    """Refuse a lattice of more than `MAX_NODES` nodes, and blame the greatest of the given keys."""
    joints, walls = specimen.counts
    nodes = joints + specimen.elements - walls
    if nodes > MAX_NODES:
        key, value = cause(specimen, inputs, causes)
        raise RefusedError(key, value, f"at most {MAX_NODES:,} nodes in all, {nodes:,} here")


def cause(specimen: Specimen, inputs: Inputs, keys: tuple[str, ...]) -> tuple[str, Any]:
    """The greatest of some keys that are given, else the last one, dotted, with its value."""
    values = {key: specimen.value(key) for key in keys if inputs.get(key) is not None}
    numbers = {key: value for key, value in values.items() if not isinstance(value, str)}
    key = max(numbers or values or keys[-1:], key=lambda key: numbers.get(key, 0.0))
    return f"lattice.{key}", specimen.value(key)


def check_thin(thickness: float, thickest: float) -> None:
    """Refuse walls that are thinner than the least share of the greatest thickness (m)."""
    if thickness < (least := THIN * thickest):
        allowed = f"at least {at_least(least)} m, a millionth of the greatest thickness"
        raise RefusedError("lattice.wall_thickness", thickness, allowed)


def thickness_of(lattice: WallLattice, mass: float, inputs: Inputs, density: float) -> float:
    """The wall thickness (m) for a mass (kg); refused if there is none, or if another one is
    given.
    """
    from sweep.design.sizing import thickness_for

    thickness, light, heavy = thickness_for(
        lattice.geometry, mass, lattice.thickest, lattice.depth, density
    )
    if isnan(thickness):
        allowed = f"between {at_least(light)} kg and {at_most(heavy)} kg with these cells"
        raise RefusedError("lattice.mass", mass, allowed)
    check_thickness(thickness, inputs)
    return thickness


def check_thickness(thickness: float, inputs: Inputs) -> None:
    """Refuse a given wall thickness that differs from the one (m) for the given mass."""
    if not isclose(inputs.get("wall_thickness", thickness), thickness, rel_tol=1e-9):
        allowed = f"{thickness:.6g} m at the mass given; give one of them"
        raise RefusedError("lattice.wall_thickness", inputs["wall_thickness"], allowed)


def check_imperfection(specimen: Specimen, where: str) -> None:
    """Refuse an imperfection of shells so large that it is a buckle itself."""
    if specimen.imperfection > MOST_IMPERFECTION:
        allowed = f"at most {MOST_IMPERFECTION:g}, in wall thicknesses, {where}"
        raise specimen.refusal("imperfection", allowed)
