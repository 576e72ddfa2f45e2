"""A custom structure: nodes and walls of a file."""

from pathlib import Path
from typing import Any, ClassVar

from sweep.config.kinds.cells import CUSTOM
from sweep.config.kinds.specimen import Specimen
from sweep.config.kinds.table import Given, NonNegative, RefusedError, chosen
from sweep.config.structures.structure import Structure
from sweep.config.structures.structure_file import faults, read_structure
from sweep.constants import MM, TO_MM


class CustomStructure(Specimen):
    """The structure in a `file`, which is connected; box and mean thickness are measured from it.

    A given `wall_thickness` scales all of its walls, so that it is their mean.
    """

    because: ClassVar[str] = 'lattice.kind is "custom"'
    constants: ClassVar[dict[str, Any]] = {
        "kind": CUSTOM,
        "cells_x": 1.0,
        "cells_y": 1.0,
        "nodes_per_wall": 0.0,
    }
    derived: ClassVar[tuple[str, ...]] = ("width", "height", "depth", "wall_thickness")
    kind: ClassVar[str] = CUSTOM
    name: ClassVar[str] = CUSTOM
    cells_x: ClassVar[int] = 1
    cells_y: ClassVar[int] = 1

    width: NonNegative
    height: NonNegative
    file: str | None = None
    structure: Structure

    def given(self) -> dict[str, Any]:
        """The values from which this follows: `kind` is "custom"."""
        return super().given() | {"kind": CUSTOM}

    @property
    def elements(self) -> int:
        """Number of elements of all walls."""
        return sum(self.structure.pieces)


def custom_structure(given: Given) -> CustomStructure:
    """The structure of these values."""
    if "structure" not in given and "file" not in given:
        allowed = "the path of a .json file, as the kind is custom"
        raise RefusedError("lattice.file", None, allowed)
    file = given.get("file")
    structure = given["structure"] if "structure" in given else read_structure(Path(given["file"]))
    if (thickness := given.get("wall_thickness")) is not None:
        structure = _scaled(structure, thickness)
    width, height = structure.size_mm
    each = structure.thickness_mm
    measured = {
        "file": Path(file).name if file else None,
        "structure": structure,
        "width": MM * width,
        "height": MM * height,
        "depth": MM * structure.depth_mm,
        "wall_thickness": MM * sum(each) / len(each),
    }
    return CustomStructure.model_validate(chosen(given, CustomStructure) | measured)


def _scaled(structure: Structure, thickness: float) -> Structure:
    """A structure whose walls are as thick on average as `thickness` (m)."""
    made = structure.with_thickness(float(f"{TO_MM * thickness:.15g}"))
    if wrong := next(faults(made), None):
        allowed = f"one that fits the structure ({wrong})"
        raise RefusedError("lattice.wall_thickness", thickness, allowed)
    return made
