"""A lattice of cells of one family, drawn in a box."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field

from sweep.config.kinds.mesh import nodes_of
from sweep.config.kinds.specimen import (
    ENDLESS,
    LAYER_HEIGHT,
    MAX_NODES,
    TIED,
    Lines,
    WallLattice,
    check_proportion,
    check_size,
    check_thin,
    thickness_of,
)
from sweep.config.kinds.table import (
    Few,
    Inputs,
    Length,
    Mass,
    RefusedError,
    Share,
    own_values,
)
from sweep.design.geometry import Geometry
from sweep.design.infill import families, trait
from sweep.numbers import at_most

CAUSES = ("infill", "cell_size", "cells_x", "cells_y", "nodes_per_wall")  # of many nodes


class Cells(WallLattice):
    """Cells of a family of infill, in walls of one thickness or of a gradient, with an outline.

    `mass` sets the wall thickness; `cell_size`, the width of a regular cell, sets the numbers of
    cells; `infill`, the share of the box that lines of `line_width` fill, as slicers count, sets
    both. boundary "periodic": one period of an endless lattice, of size `width` x `height`.
    Opposite sides are tied to each other; the mean shear strain and the mean lateral stress are
    zero. sides "periodic": left and right are tied to each other, between platens: the middle of a
    wide panel, one period of which is `width` wide; along the cells its other two sides are tied
    too, with the period `height`.
    """

    labels: ClassVar[tuple[str, ...]] = (*WallLattice.labels, "cell_size")
    needs: ClassVar[dict[str, str]] = {
        "line_width": "there are neither lattice.perimeters nor a lattice.infill",
        "layer_height": "lattice.solid_layers is 0",
    }
    words: ClassVar[tuple[str, ...]] = families()
    aperiodic: ClassVar[str] = " has walls that are graded, so that no period repeats"
    sets: ClassVar[dict[str, tuple[str, ...]]] = {
        "mass": ("wall_thickness",),
        "infill": ("wall_thickness", "cells_x", "cells_y"),
        "cell_size": ("cells_x", "cells_y"),
    }

    kind: str = "square"
    orientation: Literal["pointy", "flat"] | None = None
    boundary: Literal["free", "periodic"] = "free"
    sides: Literal["free", "periodic"] = "free"
    cells_x: Few = 3
    cells_y: Few = 3
    cell_size: Length | None = None
    mass: Mass | None = None
    infill: Share | None = None
    grading: Annotated[float, Field(ge=1e-3, le=1e3)] = 1.0
    perimeters: Lines = 0
    line_width: Length | None = None
    solid_layers: Lines = 0
    layer_height: Length | None = None

    @classmethod
    def means(cls, inputs: Inputs) -> bool:
        """Whether values mean this kind of lattice, and no other kind."""
        return True

    @classmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> Self:
        """The cells of these values. along: pressed along the cells, so that periodic sides are
        periodic in both directions.
        """
        values = own_values(inputs, cls)
        graded = values.get("grading", 1.0) != 1.0
        usual = {"nodes_per_wall": nodes_of(inputs.get("kind", "square"), graded)}
        lattice = cls.model_validate(usual | values)
        check_proportion(lattice)
        if along and lattice.tied_sides:
            lattice = lattice.model_copy(update={"layers": lattice.layers or 1})
        lattice = lattice.model_copy(update=_lines(lattice))
        if lattice.cell_size is not None:
            lattice = lattice.model_copy(update=_divided(lattice, lattice.cell_size, inputs))
        if lattice.endless or lattice.tied_sides:
            _check_period(lattice)
        if lattice.infill is not None:
            lattice = lattice.model_copy(update=_filled(lattice, lattice.infill, inputs))
        check_size(lattice, inputs, CAUSES)
        if lattice.mass is not None:
            if "wall_thickness" in inputs:
                _check_openings(lattice)
            thickness = thickness_of(lattice, lattice.mass, inputs, density)
            lattice = lattice.model_copy(update={"wall_thickness": thickness})
        _check_openings(lattice)
        return lattice

    def why_idle(self, key: str) -> str:
        """Why a key has no effect."""
        return self.needs.get(key, f'lattice.kind is "{self.kind}"')

    @property
    def geometry(self) -> Geometry:
        """The numbers that define the drawing."""
        return Geometry(
            self.kind,
            self.orientation,
            (self.cells_x, self.cells_y),
            (self.width, self.height),
            self.wall_thickness,
            self.grading,
            self.outline,
            (
                self.endless or self.tied_sides,
                self.endless or (self.tied_sides and self.layers is not None),
            ),
        )

    @property
    def walls_printed(self) -> tuple[float, ...]:
        """Thicknesses of all rows of walls, m."""
        if self.grading == 1.0:
            return super().walls_printed
        from sweep.design.box import gradient

        return tuple((self.wall_thickness * gradient(self.geometry)).tolist())

    @property
    def outline(self) -> tuple[float, float]:
        """Thickness (m) of the outline: at the left and right sides, at the bottom and top."""
        sides = self.perimeters * self.line_printed if self.perimeters else 0.0
        return sides, self.solid_layers * (self.layer_height or 0.0) or sides

    @property
    def outer_size(self) -> tuple[float, float]:
        """Outer width and height, m; for a lattice that repeats, of the period."""
        across, along = self.geometry.periodic
        width, height = super().outer_size
        return self.width if across else width, self.height if along else height

    @property
    def counts(self) -> tuple[int, int]:
        """Numbers of joints and of walls between joints."""
        rule = trait(self.kind, "counts")
        return rule(self.cells_x, self.cells_y) if rule else super().counts

    @property
    def opening(self) -> float:
        """Clear width of the narrowest whole cell between centre lines, m."""
        if rule := trait(self.kind, "opening"):
            return float(rule(self.width / self.cells_x, self.height / self.cells_y))
        from sweep.design.box import opening

        return opening(self.geometry)

    @property
    def thickest(self) -> float:
        """See `WallLattice.thickest`; with a gradient, for the mean wall."""
        if self.grading == 1.0:
            return super().thickest
        from sweep.design.box import gradient

        return super().thickest / float(gradient(self.geometry).max())


def _lines(lattice: Cells) -> dict[str, Any]:
    """The keys that only an outline, a share of infill or some families use."""
    lines = lattice.perimeters > 0 or lattice.infill is not None
    turned = trait(lattice.kind, "ORIENTED")
    return {
        "orientation": (lattice.orientation or "pointy") if turned else None,
        "line_width": lattice.line_printed if lines else None,
        "layer_height": (lattice.layer_height or LAYER_HEIGHT) if lattice.solid_layers else None,
    }


def _filled(lattice: Cells, share: float, inputs: Inputs) -> dict[str, Any]:
    """The numbers of cells and the wall thickness for a share of infill."""
    if lattice.mass is not None:
        raise lattice.refusal("mass", "none where lattice.infill is given")
    from sweep.design.sizing import cells_for

    width = lattice.line_printed
    reason = f"as lattice.infill is {100 * share:g} %; give one of them"
    _check_follows("wall_thickness", width, f"{width:g} m, {reason}", inputs)
    thin = lattice.model_copy(update={"wall_thickness": width})
    count = cells_for(thin.geometry, share, MAX_NODES)
    if count is None:
        lines = f"lines of {width:g} m in this box"
        raise lattice.refusal("infill", f"a share that 1 to {MAX_NODES:,} cells fill with {lines}")
    return {"wall_thickness": width} | _following(count, reason, inputs)


def _divided(lattice: Cells, size: float, inputs: Inputs) -> dict[str, int]:
    """The numbers of cells that come nearest to a size."""
    if lattice.infill is not None:
        raise lattice.refusal("cell_size", "none where lattice.infill is given")
    from sweep.design.sizing import cell_of, cells_of_size

    count = cells_of_size(lattice.geometry, size, MAX_NODES)
    if count is None:
        width, height = cell_of(lattice.geometry._replace(cells=(1, 1)))
        box = f"a single cell is {width:.4g} m wide, or {height:.4g} m high"
        allowed = (
            f"the width of a cell of which 1 to {MAX_NODES:,} fit, regular within a third; {box}"
        )
        raise lattice.refusal("cell_size", allowed)
    reason = f"as lattice.cell_size is {size:g} m; give one of them"
    return _following(count, reason, inputs)


def _following(count: tuple[int, int], reason: str, inputs: Inputs) -> dict[str, int]:
    """The numbers of cells that follow from other keys."""
    follows = dict(zip(("cells_x", "cells_y"), count, strict=True))
    for key, value in follows.items():
        _check_follows(key, value, f"{value}, {reason}", inputs)
    return follows


def _check_follows(key: str, value: object, allowed: str, inputs: Inputs) -> None:
    """Refuse a given value that differs from the value that follows from other keys."""
    if inputs.get(key, value) != value:
        raise RefusedError(f"lattice.{key}", inputs[key], allowed)


def _check_openings(lattice: Cells) -> None:
    """Refuse walls as thick as the openings between them, and an outline that fills cells."""
    limit, thickness = lattice.thickest, lattice.wall_thickness
    if thickness >= limit * (1.0 - 1e-12):
        if lattice.infill is not None:
            allowed = "a share that leaves cells at least twice as wide as their walls"
            raise lattice.refusal("infill", allowed)
        allowed = f"below half the width of the narrowest cell, {at_most(limit)} m here"
        raise lattice.refusal("wall_thickness", allowed)
    check_thin(thickness, limit)
    gap = lattice.opening - thickness
    for axis, key in enumerate(("perimeters", "solid_layers")):
        outline, count = lattice.outline[axis], getattr(lattice, key)
        if count and outline >= gap:
            most = int(gap / (outline / count))
            allowed = f"at most {most} here, thinner in all than cells are open, {gap:.4g} m"
            raise lattice.refusal(key, allowed)


def _check_period(lattice: Cells) -> None:
    """Refuse a lattice that cannot be a period, or that is periodic in two ways."""
    if lattice.endless and lattice.tied_sides:
        raise lattice.refusal("sides", f'"free" {ENDLESS}')
    endless = ENDLESS if lattice.endless else TIED
    for key, value in {"grading": 1.0, "perimeters": 0, "solid_layers": 0, "infill": None}.items():
        if getattr(lattice, key) != value:
            text = "none" if value is None else f"{value:g}"
            raise lattice.refusal(key, f"{text} {endless}")
    flat = lattice.orientation == "flat"
    key, row = ("cells_x", "column") if flat else ("cells_y", "row")
    repeats = lattice.geometry.periodic[0 if flat else 1]
    if repeats and trait(lattice.kind, "STAGGERED") and getattr(lattice, key) % 2:
        allowed = f"an even number {endless}, as every other {row} of {lattice.kind} is shifted"
        raise lattice.refusal(key, allowed)
