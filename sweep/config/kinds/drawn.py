"""A lattice from a user's own drawing, pressed as the built-in infills are."""

from functools import lru_cache
from math import inf, isclose, sqrt
from pathlib import Path
from typing import Annotated, Any, ClassVar, Final, Self

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from sweep.config.kinds.mesh import nodes_of
from sweep.config.kinds.specimen import (
    WallLattice,
    check_proportion,
    check_size,
    check_thin,
    thickness_of,
)
from sweep.config.kinds.table import COMPUTED, Inputs, Length, Mass, RefusedError, own_values
from sweep.design.geometry import Drawing, Geometry
from sweep.numbers import at_most

DRAWN: Final = "drawn"
DIGITS = 12  # decimals of a coordinate in m, so that equal drawings of all formats are equal

SIZED = 1e-6  # relative error of a stated size of the drawing


def _sound(drawing: Drawing) -> Drawing:
    """A drawing moved to its lower left corner, whose walls each end at two of its joints; all are
    used.
    """
    used = {joint for wall in drawing.walls for joint in wall}
    apart = all(a != b for a, b in drawing.walls)
    even = len(drawing.shares) in (0, len(drawing.walls)) and all(s > 0.0 for s in drawing.shares)
    if not (apart and even and drawing.joints and used == set(range(len(drawing.joints)))):
        raise PydanticCustomError("drawing", "walls between two of the joints, all of them used")
    if any(min(at[axis] for at in drawing.joints) != 0.0 for axis in (0, 1)):
        raise PydanticCustomError("drawing", "joints whose least x and y are 0")
    return drawing


class Drawn(WallLattice):
    """The walls in a `file`, which meet where they cross and are in one piece.

    file_unit: length of one unit of the file, which replaces the unit that it states. `mass` sets
    the wall thickness, the mean of all walls weighted by length. Box and joints follow from the
    file.
    """

    because: ClassVar[str] = f'lattice.kind is "{DRAWN}"'
    labels: ClassVar[tuple[str, ...]] = (*WallLattice.labels, "file_unit")
    constants: ClassVar[dict[str, Any]] = {"kind": DRAWN}
    derived: ClassVar[tuple[str, ...]] = ("width", "height")
    sets: ClassVar[dict[str, tuple[str, ...]]] = {"mass": ("wall_thickness",)}
    replaces: ClassVar[dict[str, tuple[str, ...]]] = {
        "file": ("drawing",),
        "file_unit": ("drawing",),
    }
    words: ClassVar[tuple[str, ...]] = (DRAWN,)
    aperiodic: ClassVar[str] = (
        " is a drawing, of which no period is known that could be repeated without end"
    )
    kind: ClassVar[str] = DRAWN

    file: str | None = None
    file_unit: Length | None = None
    drawing: Annotated[Drawing, AfterValidator(_sound), COMPUTED]
    mass: Mass | None = None

    @classmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> Self:
        """The drawing of these values."""
        if "drawing" not in inputs and "file" not in inputs:
            raise RefusedError("lattice.file", None, "the path of a drawing, as the kind is drawn")
        usual: dict[str, Any] = {"nodes_per_wall": nodes_of(DRAWN)}
        values = {key: v for key, v in own_values(inputs, cls).items() if key not in cls.derived}
        if "drawing" not in inputs:
            usual |= _of_file(inputs)
            values["file"] = Path(inputs["file"]).name
        lattice = cls.model_validate(usual | values)
        width, height = (max(at[axis] for at in lattice.drawing.joints) for axis in (0, 1))
        lattice = cls.model_validate(dict(lattice) | {"width": width, "height": height})
        _check_sides(lattice, inputs)
        check_proportion(lattice)
        check_size(lattice, inputs, ("nodes_per_wall", "file"))
        if lattice.mass is not None:
            thickness = thickness_of(lattice, lattice.mass, inputs, density)
            return lattice.model_copy(update={"wall_thickness": thickness})
        if lattice.wall_thickness >= lattice.thickest:
            allowed = f"below half the width of the widest cell, {at_most(lattice.thickest)} m here"
            raise lattice.refusal("wall_thickness", allowed)
        check_thin(lattice.wall_thickness, lattice.thickest)
        return lattice

    @classmethod
    def idle(cls, inputs: Inputs) -> dict[str, str]:
        """The keys of cells, which have no meaning here."""
        own = {**cls.neutral, **cls.constants}
        others = (key for key in inputs if key not in cls.model_fields)
        return {key: cls.because for key in others if own.get(key) != inputs[key]}

    @classmethod
    def check_file(cls, path: Path) -> list[str]:
        """Refuse a file that is no drawing; else return notes on parts that are left out."""
        from sweep.config.drawings.drawing_file import read_drawing

        return list(read_drawing(path).lines.notes)

    def inputs(self) -> dict[str, Any]:
        """The values from which this follows."""
        return super().inputs() | {"kind": DRAWN}

    @property
    def name(self) -> str:
        """The name of its file."""
        return self.file or DRAWN

    @property
    def geometry(self) -> Geometry:
        """The numbers that define the drawing."""
        box = self.width, self.height
        return Geometry(DRAWN, None, (1, 1), box, self.wall_thickness, drawing=self.drawing)

    @property
    def elements(self) -> int:
        """Number of elements of all walls."""
        return int(self.wall_quads.sum())

    @property
    def wall_quads(self) -> Any:
        """Number of elements along each wall, and of quads where it stands (w,)."""
        return self.network.pieces(self.nodes_per_wall + 1)

    @property
    def walls_printed(self) -> tuple[float, ...]:
        """Thicknesses of all walls, m."""
        return tuple(sorted(set(self.network.wall_thickness.tolist())))

    @property
    def cells_x(self) -> int:
        """About how many cells there are across, as in a square grid with the same number of
        cells.
        """
        return max(1, round(self.width / self._cell))

    @property
    def cells_y(self) -> int:
        """About how many cells there are from bottom to top."""
        return max(1, round(self.height / self._cell))

    @property
    def _cell(self) -> float:
        joints, walls = self.counts
        return sqrt(self.width * self.height / max(1, walls - joints + 1))

    @property
    def opening(self) -> float:
        """Clear width of the narrowest cell between centre lines, m; infinite if there is none."""
        return _openings(self.drawing)[0]

    @property
    def thickest(self) -> float:
        """Wall thickness (m) at which even the widest opening is as wide as its walls are thick."""
        return 0.5 * min(_openings(self.drawing)[1], self.width, self.height)


def _check_sides(lattice: Drawn, inputs: Inputs) -> None:
    """Refuse sizes that differ from the drawing."""
    refused = [
        RefusedError(
            f"lattice.{key}",
            inputs[key],
            f"{size:.6g} m, the size of the drawing; lattice.file_unit changes it",
        )
        for key in Drawn.derived
        for size in [getattr(lattice, key)]
        if not isclose(inputs.get(key, size), size, rel_tol=SIZED)
    ]
    if refused:
        refused[0].also = refused[1:]
        raise refused[0]


@lru_cache(maxsize=256)
def _openings(drawing: Drawing) -> tuple[float, float]:
    """Clear widths (m) of the narrowest and of the widest cell; infinite if there is none."""
    import numpy as np

    from sweep.design.box import clear_widths

    widths = clear_widths(np.array(drawing.joints), np.array(drawing.walls))
    return float(widths.min(initial=inf)), float(widths.max()) if len(widths) else inf


def _of_file(inputs: Inputs) -> dict[str, Any]:
    """The values that the file of a drawing states."""
    import numpy as np

    from sweep.config.drawings.drawing_file import read_drawing

    path = Path(inputs["file"])
    network, lines = read_drawing(path)
    unit = inputs.get("file_unit") or lines.unit
    if lines.named and "file_unit" in inputs:
        allowed = f"none, as {path.name} itself names the unit of its numbers"
        raise RefusedError("lattice.file_unit", unit, allowed)
    if unit is None:
        allowed = f'the length of one unit of {path.name}, such as "1 mm", as it names none'
        raise RefusedError("lattice.file_unit", None, allowed)
    joints = (unit * network.joints).round(DIGITS)
    walls = network.walls
    values: dict[str, Any] = {}
    shares: tuple[float, ...] = ()
    if lines.thickness is not None:
        thickness = unit * lines.thickness[network.line]
        start, end = joints[walls].swapaxes(0, 1)
        mean = float(np.average(thickness, weights=np.linalg.norm(end - start, axis=1)))
        values["wall_thickness"] = float(f"{mean:.12g}")
        if np.ptp(thickness) > 1e-9 * mean:
            shares = tuple((thickness / mean).round(DIGITS).tolist())
    if lines.depth is not None:
        values["depth"] = lines.depth
    if lines.elements is not None:
        values["nodes_per_wall"] = lines.elements - 1
    at, pairs = (tuple(map(tuple, array.tolist())) for array in (joints, walls))
    return values | {"drawing": Drawing(at, pairs, shares)}
