"""What all specimens have: a box over centre lines, walls, a mesh and an imperfection."""

from abc import abstractmethod
from math import isclose, isnan
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from sweep.config.kinds.table import Few, Given, Length, RefusedError, Size, Table
from sweep.design.geometry import Geometry

NOZZLE, LAYER_HEIGHT = 0.4e-3, 0.2e-3  # m
# The factor of a lattice of 70 000 nodes takes 8 GB, and a step several minutes.
MAX_NODES = 50_000
MAX_ASPECT = 1000.0  # of the box; above it the computed areas lose their accuracy

Lines = Annotated[int, Field(ge=0, le=100)]
Nodes = Annotated[int, Field(ge=0, le=1000)]
Imperfection = Annotated[float, Field(ge=0, le=100, json_schema_extra={"unit": "1", "bare": True})]


class Specimen(Table):
    """A specimen: its outer size over centre lines, and the mesh of its walls.

    nozzle: width of a line where lines are not used otherwise. printable: what does not print is
    refused. layers: quads up the height of a lattice that is pressed along its cells; None across
    them. symmetry "quarter": such a lattice is cut at its two mirror planes. imperfection_seed: of
    the shape of its imperfection; None: the shape in which equal walls buckle.
    """

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

    @property
    def endless(self) -> bool:
        """Whether this is one period of an endless lattice."""
        return False

    @property
    def tied(self) -> bool:
        """Whether its left and right sides are tied to each other."""
        return False

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
        """Width and height over all (m), with walls of mean thickness where there is no outline."""
        sides, caps = (outline or self.wall_thickness for outline in self.outline)
        return self.width + sides, self.height + caps


class Laid(Specimen):
    """A specimen whose walls follow from a few numbers, its `geometry`."""

    nodes_per_wall: Nodes

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

        return counts(sketch(self.geometry))

    @property
    def elements(self) -> int:
        """Number of elements of all walls."""
        return self.counts[1] * (self.nodes_per_wall + 1)


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


def check_size(specimen: Laid, causes: tuple[str, ...]) -> None:
    """Refuse a lattice of more than `MAX_NODES` nodes, by the greatest value of keys."""
    joints, walls = specimen.counts
    nodes = joints + specimen.elements - walls
    if nodes > MAX_NODES:
        values = {key: getattr(specimen, key) for key in causes}
        key = max(values, key=values.__getitem__)
        allowed = f"at most {MAX_NODES:,} nodes in all, {nodes:,} here"
        raise RefusedError(f"lattice.{key}", values[key], allowed)


def thickness_of(made: Laid, mass: float, given: Given, density: float) -> float:
    """The wall thickness (m) of a mass (kg); refused if there is none, or another is given."""
    from sweep.design.sizing import thickness_for

    thickness, light, heavy = thickness_for(made.geometry, mass, made.thickest, made.depth, density)
    if isnan(thickness):
        allowed = f"between {light:.4g} kg and {heavy:.4g} kg with these cells"
        raise RefusedError("lattice.mass", mass, allowed)
    if not isclose(given.get("wall_thickness", thickness), thickness, rel_tol=1e-9):
        allowed = f"{thickness:.6g} m at the mass given; give one of them"
        raise RefusedError("lattice.wall_thickness", given["wall_thickness"], allowed)
    return thickness
