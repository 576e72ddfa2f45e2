"""A sheet that divides space in two, such as the gyroid, between platens: a period of a panel, or a
block.
"""

from collections.abc import Callable
from math import inf, isfinite
from typing import Annotated, Any, ClassVar, Literal, TypeVar

from sweep.config.kinds.direction import ACROSS, ALONG, Direction
from sweep.config.kinds.specimen import (
    Nodes,
    Specimen,
    check_imperfection,
    check_thickness,
    check_thin,
    pressed_height,
)
from sweep.config.kinds.table import COMPUTED, Inputs, Length, Mass, RefusedError, own_values
from sweep.design.surfaces.names import BLOCK, SHEETS, Cut
from sweep.numbers import at_least, at_most

QUADS = 3  # nodes inside half a period: 8 quads a period
CELL_SIZE = 0.5  # share of the pressed height: two periods
THICKEST = 0.2  # share of a period, about half of the clear width of a channel
NARROW = "where walls are below a fifth of the period"
S = TypeVar("S", bound="Surface")
LEAST = 0.6  # share of the wanted period
MOST_NODES = 11  # 24 quads a period: finer than any study has needed
MOST_QUADS = 20_000  # each with six unknowns
SIDES = ("width", "height", "depth")
FINER = 1.7  # quads of a wall / quads of a sheet of equal area: curves divide it


class Surface(Specimen):
    """A periodic surface as a sheet, layers stacked along `depth`.

    A panel repeats without end along its sides: one period of it is computed, whose size does not
    change. `period` (m): of the surface; the pressed height is a whole number of steps of
    `names.Cut.step` periods. The imperfection is drawn by its seed, 0 by default.
    """

    derived: ClassVar[tuple[str, ...]] = ("period", "pressed", "width")
    constants: ClassVar[dict[str, Any]] = {"cells_x": 1.0, "cells_y": 1.0}
    aperiodic: ClassVar[str] = " is a curved sheet: moduli are computed of straight walls only"
    neutral: ClassVar[dict[str, Any]] = {
        key: value for key, value in Specimen.neutral.items() if key != "sides"
    }

    period: Annotated[Length, COMPUTED]
    pressed: Annotated[Direction, COMPUTED]
    nodes_per_wall: Nodes = QUADS

    def inputs(self) -> dict[str, Any]:
        """The values from which this follows: of height and depth only the pressed one."""
        lateral = "height" if self.pressed == ALONG else "depth"
        return {key: value for key, value in super().inputs().items() if key != lateral}

    @property
    def sheet(self) -> str:
        """The name of the surface."""
        return str(self.value("kind"))

    @property
    def turned(self) -> bool:
        """Whether it is pressed between two of its axes, not along one."""
        return False

    @property
    def tied_sides(self) -> bool:
        """Its sides repeat."""
        return True

    @property
    def sides(self) -> str:
        """How its sides are tied, in the values of the key of other lattices."""
        return "periodic" if self.tied_sides else "free"

    def why_idle(self, key: str) -> str:
        """Why a key has no effect."""
        if key in ("sides", *SIDES) and self.tied_sides:
            pressed = "depth" if self.pressed == ALONG else "height"
            way = f'of which loading.direction "{self.pressed}" presses lattice.{pressed}'
            return f"one period of a panel is computed, {way}"
        return self.sheet_clause(self.inputs())

    @property
    def pressed_height(self) -> float:
        """The pressed height, m."""
        return self.depth if self.pressed == ALONG else self.height

    @property
    def cells_x(self) -> int:
        """About how many periods are side by side."""
        return max(1, round(self.width / self.period)) if not self.tied_sides else 1

    @property
    def cells_y(self) -> int:
        """About how many periods are pressed above one another."""
        return max(1, round(self.pressed_height / self.period))

    @property
    def outer_size(self) -> tuple[float, float]:
        """Overall width and height, m."""
        return self.width + self.outline[0], self.height + self.outline[1]

    @property
    def box(self) -> tuple[float, float, float]:
        """Width, the other lateral side, and the height pressed, m."""
        if self.pressed == ALONG:
            return self.width, self.height, self.depth
        return self.width, self.depth, self.height

    @property
    def walled(self) -> tuple[int, int]:
        """The axes of `box` across which a block has perimeters."""
        return (0, 1) if self.pressed == ALONG else (0, 2)

    @property
    def inside(self) -> float:
        """Share of the box that is inside the perimeters."""
        (sides, caps), (width, height) = self.outline, (self.width, self.height)
        return (1.0 - sides / width) * (1.0 - caps / height)

    @property
    def framed(self) -> float:
        """Volume of the perimeters, m^3."""
        width, height = self.outer_size
        hollow = (self.width - self.outline[0]) * (self.height - self.outline[1])
        return self.depth * (width * height - hollow)

    @property
    def area(self) -> float:
        """Area of the sheet, m^2."""
        return SHEETS[self.sheet].area / self.period * self.width * self.height * self.depth

    @property
    def counted_volume(self) -> float:
        """Volume of the sheet of one period, m^3."""
        return self.wall_thickness * self.area

    @property
    def extruded(self) -> float:
        """Volume as printed, m^3."""
        return self.counted_volume

    @property
    def elements(self) -> int:
        """About how many quads the sheet is divided into."""
        (width, height), depth = (self.width, self.height), self.depth
        walls = 0.0 if self.tied_sides else FINER * 2.0 * (width + height) * depth
        return round((self.area + walls) * (self.quads_per_period / self.period) ** 2)

    @property
    def misfit(self) -> str:
        """The fault that a larger period would correct: too many quads, or walls too thick; empty
        if none.
        """
        if self.elements > MOST_QUADS:
            return f"where the mesh has at most {MOST_QUADS:,} quads"
        return NARROW if self.wall_thickness >= THICKEST * self.period else ""

    @property
    def quads_per_period(self) -> int:
        """Cells of the grid of the mesh in a period."""
        return 2 * (self.nodes_per_wall + 1)


class Sheet(Surface):
    """A periodic minimal surface of one thickness.

    `cell_size` is the wanted period; `mass`, of the computed part, sets the wall thickness.
    """

    labels: ClassVar[tuple[str, ...]] = (*Specimen.labels, "cell_size")
    words: ClassVar[tuple[str, ...]] = tuple(SHEETS)
    sets: ClassVar[dict[str, tuple[str, ...]]] = {"mass": ("wall_thickness",)}

    kind: Literal["gyroid", "schwarz_p", "schwarz_d"]
    cell_size: Length | None = None
    mass: Mass | None = None

    @classmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> "Sheet":
        """The sheet of these values."""
        cut = SHEETS[inputs["kind"]].straight
        height, step = pressed_height(inputs, along), cut.step

        def draft(period: float) -> Sheet:
            lattice = cls.model_validate(
                own_values(inputs, cls) | fitted(inputs, along, period, cut)
            )
            if lattice.mass is None:
                return lattice
            return lattice.model_copy(
                update={"wall_thickness": lattice.mass / (density * lattice.area)}
            )

        target = inputs.get("cell_size", CELL_SIZE * height)
        lattice = checked(draft(target))
        if lattice.mass is not None:
            check_thickness(lattice.wall_thickness, inputs)
        check_thin(lattice.wall_thickness, THICKEST * lattice.period)
        if lattice.misfit:
            raise _misfit(lattice, inputs, *narrowest(lattice, draft, step))
        if target > widest(height, step):
            allowed = f"at most {at_most(widest(height, step))} m where {height:.6g} m are pressed"
            raise RefusedError("lattice.cell_size", target, allowed)
        return lattice

    @classmethod
    def sheet_clause(cls, inputs: Inputs) -> str:
        """Why walls of these values are a sheet."""
        return f'lattice.kind is "{inputs["kind"]}"'


def _misfit(lattice: Sheet, inputs: Inputs, least: float, why: str) -> RefusedError:
    """The refusal of the period, of the wall thickness, or of the mass; least: the least period,
    m.
    """
    thick = {"mass", "wall_thickness"} & inputs.keys() and lattice.misfit == NARROW
    if "cell_size" in inputs and not thick and isfinite(least):
        allowed = f"at least {at_least(least)} m, {why}"
        return RefusedError("lattice.cell_size", inputs["cell_size"], allowed)
    key, unit = ("mass", "kg") if lattice.mass else ("wall_thickness", "m")
    most = lattice.value(key) * THICKEST * lattice.period / lattice.wall_thickness
    return lattice.refusal(key, f"below {at_most(most)} {unit}, {NARROW}")


def widest(height: float, step: float) -> float:
    """The greatest period that fits a height, m; step: in periods."""
    return height / (step * LEAST)


def narrowest(lattice: S, draft: Callable[[float], S], step: float) -> tuple[float, str]:
    """The least wanted period (m) for which `draft` makes a sheet without `misfit`, infinite if
    there is none, and the misfit of smaller ones. lattice: a sheet with a misfit; step: in periods.
    """
    good, bad = 0, round(lattice.pressed_height / (step * lattice.period))  # steps
    why = lattice.misfit
    while bad - good > 1:
        steps = (good + bad) // 2
        misfit = draft(lattice.pressed_height / (step * steps)).misfit
        good, bad, why = (good, steps, misfit) if misfit else (steps, bad, why)
    return lattice.pressed_height / (step * (good + 0.5)) * (1.0 + 1e-9) if good else inf, why


def fitted(inputs: Inputs, along: bool, target: float, cut: Cut | None) -> dict[str, Any]:
    """The sizes of a panel, or, without a ``cut``, of a block, with the period nearest to
    ``target`` (m) for which the pressed height is a whole number of steps.

    All sides of a block are whole numbers of `BLOCK` periods.
    """
    height, step = pressed_height(inputs, along), cut.step if cut else BLOCK
    period = height / (step * max(round(height / (step * target)), 1))
    across, pressed = ("height", "depth") if along else ("depth", "height")
    if cut:
        sizes = {"width": cut.across * period, across: cut.along * period}
    else:
        given = {side: inputs.get(side, Specimen.model_fields[side].default) for side in SIDES}
        whole = step * period
        sizes = {side: whole * max(round(size / whole), 1) for side, size in given.items()}
    return sizes | {pressed: height, "period": period, "pressed": ALONG if along else ACROSS}


def checked(lattice: S) -> S:
    """The sheet, if its mesh is neither too fine nor too coarse.

    Keys of upright walls that it does not have are dropped.
    """
    if not 1 <= lattice.nodes_per_wall <= MOST_NODES:
        raise lattice.refusal("nodes_per_wall", f"1 to {MOST_NODES}, in half a period of a sheet")
    check_imperfection(lattice, "of a sheet")
    seed = (lattice.imperfection_seed or 0) if lattice.imperfection else None
    unused = {"layers": None, "symmetry": "none"}
    return lattice.model_copy(update=unused | {"imperfection_seed": seed})
