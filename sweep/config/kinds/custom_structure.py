"""A custom structure: nodes and walls of a file."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Self

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from sweep.config.kinds.specimen import Specimen
from sweep.config.kinds.table import COMPUTED, Inputs, NonNegative, RefusedError, own_values
from sweep.config.structures.structure import Structure
from sweep.config.structures.structure_file import StructureError, faults, read_structure
from sweep.constants import MM, TO_MM

if TYPE_CHECKING:
    from sweep.design.network import Network

CUSTOM: Final = "custom"


def _sound(structure: Structure) -> Structure:
    """A structure without a fault."""
    for line in faults(structure):
        raise PydanticCustomError("structure", "{line}", {"line": line})
    return structure


class CustomStructure(Specimen):
    """The structure in a `file`, which is connected; box and mean thickness are measured from it.

    A given `wall_thickness` scales all of its walls, so that it becomes their mean.
    """

    because: ClassVar[str] = 'lattice.kind is "custom"'
    constants: ClassVar[dict[str, Any]] = {
        "kind": CUSTOM,
        "cells_x": 1.0,
        "cells_y": 1.0,
        "nodes_per_wall": 0.0,
    }
    derived: ClassVar[tuple[str, ...]] = ("width", "height", "depth", "wall_thickness")
    replaces: ClassVar[dict[str, tuple[str, ...]]] = {"file": ("structure",)}
    words: ClassVar[tuple[str, ...]] = (CUSTOM,)
    aperiodic: ClassVar[str] = (
        " is a structure with its own supports and loads, which does not repeat"
    )
    across: ClassVar[dict[str, Any]] = Specimen.across | {"imperfection": 0.0}
    kind: ClassVar[str] = CUSTOM
    cells_x: ClassVar[int] = 1
    cells_y: ClassVar[int] = 1

    width: NonNegative
    height: NonNegative
    file: str | None = None
    structure: Annotated[Structure, AfterValidator(_sound), COMPUTED]

    @classmethod
    def of(cls, inputs: Inputs, density: float, along: bool) -> Self:
        """The structure of these values."""
        if "structure" not in inputs and "file" not in inputs:
            allowed = "the path of a .json file, as the kind is custom"
            raise RefusedError("lattice.file", None, allowed)
        structure = inputs.get("structure") or read_structure(Path(inputs["file"]))
        if (thickness := inputs.get("wall_thickness")) is not None:
            structure = _scaled(structure, thickness)
        width, height = structure.size_mm
        each = structure.thickness_mm
        measured = {
            "file": Path(inputs["file"]).name if inputs.get("file") else None,
            "structure": structure,
            "width": MM * width,
            "height": MM * height,
            "depth": MM * structure.depth_mm,
            "wall_thickness": MM * sum(each) / len(each),
        }
        return cls.model_validate(own_values(inputs, cls) | measured)

    @classmethod
    def check_file(cls, path: Path) -> list[str]:
        """Refuse a file that is no structure; a drawing is told by its ending."""
        from sweep.config.drawings.drawing_file import READERS

        if path.suffix.lower() in READERS.keys() - {".json"}:
            raise StructureError(['a drawing; needed: lattice.kind = "drawn"'])
        read_structure(path)
        return []

    @property
    def network(self) -> "Network":
        """Centre lines and thickness of the walls, m; there are no bottom and top rows."""
        import numpy as np

        from sweep.design.network import Network

        points, none = MM * np.array(self.structure.nodes_mm), np.empty(0, np.int64)
        thickness = MM * np.array(self.structure.thickness_mm)
        return Network(points, np.array(self.structure.walls), thickness, none, none)

    @property
    def counted_volume(self) -> float:
        """Volume of the walls as budgets count it, m^3."""
        return self.depth * self.network.printed_area

    @property
    def pieces(self) -> tuple[int, ...]:
        """Number of elements of each wall."""
        return self.structure.pieces

    def remeshed(self, pieces: tuple[int, ...]) -> dict[str, Any]:
        """The changes for other numbers of `pieces`."""
        return {"structure": self.structure.model_copy(update={"subdivide": pieces})}

    def check_standing(self, where: str) -> None:
        """Refuse parts other than walls; where: why the walls stand upright, in words."""
        if unfit := self.structure.beside_walls:
            allowed = f"a file without {', '.join(unfit)} {where}: its walls stand on platens"
            raise self.refusal("file", allowed)

    @property
    def walls_printed(self) -> tuple[float, ...]:
        """Thicknesses of all walls, m."""
        return tuple(MM * thickness for thickness in self.structure.thickness_mm)

    def inputs(self) -> dict[str, Any]:
        """The values from which this follows: `kind` is "custom"."""
        return super().inputs() | {"kind": CUSTOM}

    @property
    def elements(self) -> int:
        """Number of elements of all walls."""
        return sum(self.structure.pieces)


def _scaled(structure: Structure, thickness: float) -> Structure:
    """A structure whose walls are as thick on average as `thickness` (m)."""
    scaled = structure.with_thickness(float(f"{TO_MM * thickness:.15g}"))
    if wrong := next(faults(scaled), None):
        allowed = f"one that fits the structure ({wrong})"
        raise RefusedError("lattice.wall_thickness", thickness, allowed)
    return scaled
