"""A sheet that divides space in two, such as the gyroid: one period of a panel between platens."""

from math import isclose
from typing import Any, ClassVar, Literal

from sweep.config.kinds.direction import ACROSS, ALONG, Direction
from sweep.config.kinds.specimen import Nodes, Specimen
from sweep.config.kinds.table import Given, Length, Mass, RefusedError, chosen
from sweep.constants import TO_MM
from sweep.design.surfaces.names import SHEETS, Cut

QUADS = 3  # nodes inside half a period: 8 quads a period
CELL_SIZE = 0.5  # of the height pressed: two periods
THICKEST = 0.2  # of a period, about half of the clear width of a channel
LEAST, MOST = 0.6, 1.7  # of the period wanted
MOST_NODES = 11  # 24 quads a period: finer than any study has needed


class Sheet(Specimen):
    """A periodic minimal surface of one thickness, layers stacked along `depth`.

    The panel repeats without end along its sides: one period of it is computed, whose `period`
    does not change. The height pressed is a whole number of quarters of the period (of the
    diagonal of two periods across the layers); `cell_size` is the period wanted. `mass` is that of
    what is computed, and sets the wall thickness.
    """

    because: ClassVar[str] = "lattice.kind is a sheet, one period of which is computed"
    labels: ClassVar[tuple[str, ...]] = (*Specimen.labels, "cell_size")
    derived: ClassVar[tuple[str, ...]] = ("period", "pressed", "width")
    constants: ClassVar[dict[str, Any]] = {"cells_x": 1.0, "cells_y": 1.0}
    cells_x: ClassVar[int] = 1

    kind: Literal["gyroid", "schwarz_p", "schwarz_d"]
    cell_size: Length | None = None
    period: Length
    pressed: Direction
    mass: Mass | None = None
    nodes_per_wall: Nodes = QUADS

    def given(self) -> dict[str, Any]:
        """The values from which this follows: one of height and depth, mass or wall thickness."""
        lateral = "height" if self.pressed == ALONG else "depth"
        without = {lateral, "wall_thickness" if self.mass is not None else ""}
        return {key: value for key, value in super().given().items() if key not in without}

    @property
    def name(self) -> str:
        """The name of the surface."""
        return self.kind

    @property
    def tied(self) -> bool:
        """Its sides repeat."""
        return True

    @property
    def sheet(self) -> str:
        """The name of the surface."""
        return self.kind

    @property
    def pressed_height(self) -> float:
        """The height that is pressed, m."""
        return self.depth if self.pressed == ALONG else self.height

    @property
    def cells_y(self) -> int:
        """About how many periods are pressed above one another."""
        return max(1, round(self.pressed_height / self.period))

    @property
    def outer_size(self) -> tuple[float, float]:
        """Width and height over all, m: those of the period."""
        return self.width, self.height

    @property
    def area(self) -> float:
        """Area of the sheet, m^2."""
        return SHEETS[self.kind].area / self.period * self.width * self.height * self.depth

    @property
    def volume(self) -> float:
        """Volume of the sheet, m^3."""
        return self.wall_thickness * self.area

    @property
    def elements(self) -> int:
        """About how many quads the sheet is divided into."""
        return round(self.area * (self.quads_per_period / self.period) ** 2)

    @property
    def quads_per_period(self) -> int:
        """Cells of the grid of the mesh in a period."""
        return 2 * (self.nodes_per_wall + 1)

    @property
    def cut(self) -> Cut:
        """How its panel lies in the surface."""
        return SHEETS[self.kind].cuts[self.pressed]


def sheet(given: Given, density: float, along: bool) -> Sheet:
    """The sheet of these values; density (kg/m^3): of the material. along: whether it is pressed
    along the print axis.
    """
    key, direction = ("depth", ALONG) if along else ("height", ACROSS)
    height = given.get(key, Specimen.model_fields[key].default)
    period = _period(given, SHEETS[given["kind"]].cuts[direction], height)
    cut = SHEETS[given["kind"]].cuts[direction]
    sides = {"width": cut.across * period, "height" if along else "depth": cut.along * period}
    values = chosen(given, Sheet) | {key: height} | sides
    made = Sheet.model_validate(values | {"period": period, "pressed": direction})
    if made.nodes_per_wall > MOST_NODES:
        raise RefusedError("lattice.nodes_per_wall", made.nodes_per_wall, f"at most {MOST_NODES}")
    if made.mass is not None:
        made = _weighing(made, made.mass, given, density)
    most = THICKEST * period
    if made.wall_thickness >= most:
        allowed = f"below a fifth of the period, {most:.4g} m here"
        raise RefusedError("lattice.wall_thickness", made.wall_thickness, allowed)
    return made if made.imperfection else made.model_copy(update={"imperfection_seed": None})


def _period(given: Given, cut: Cut, height: float) -> float:
    """The period that fits a height, m, nearest to `cell_size`."""
    size = given.get("cell_size", CELL_SIZE * height)
    steps = max(round(height / (cut.step * size)), 1)
    period = height / (cut.step * steps)
    if not LEAST <= period / size <= MOST:
        allowed = f"at most {TO_MM * height / (cut.step * LEAST):.4g} mm at this height"
        raise RefusedError("lattice.cell_size", size, allowed)
    return period


def _weighing(made: Sheet, mass: float, given: Given, density: float) -> Sheet:
    """The sheet whose wall thickness gives it a mass, kg."""
    thickness = mass / (density * made.area)
    if not isclose(given.get("wall_thickness", thickness), thickness, rel_tol=1e-9):
        allowed = f"{thickness:.6g} m at the mass given; give one of them"
        raise RefusedError("lattice.wall_thickness", given["wall_thickness"], allowed)
    return made.model_copy(update={"wall_thickness": thickness})
