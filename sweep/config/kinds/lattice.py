"""The kinds of lattice."""

from typing import Annotated, Any

from pydantic import Discriminator, Tag

from sweep.config.kinds.cells import CUSTOM, DRAWN, Cells
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.drawn import Drawn
from sweep.config.kinds.sheet import Sheet
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.config.kinds.table import Given
from sweep.design.slicer.patterns import SHEET_PATTERNS
from sweep.design.surfaces.names import SHEETS


def _kind(value: Any) -> str:
    """The kind of a lattice, or of its values."""
    fields = value if isinstance(value, dict) else getattr(value, "__dict__", {})
    if "period" in fields:
        return "sliced_sheet" if "slicer" in fields else "sheet"
    kinds = {"structure": "custom", "drawing": "drawn", "slicer": "sliced"}
    return next((kind for key, kind in kinds.items() if key in fields), "cells")


Lattice = Annotated[
    Annotated[Cells, Tag("cells")]
    | Annotated[Sliced, Tag("sliced")]
    | Annotated[Sheet, Tag("sheet")]
    | Annotated[SlicedSheet, Tag("sliced_sheet")]
    | Annotated[CustomStructure, Tag("custom")]
    | Annotated[Drawn, Tag("drawn")],
    Discriminator(_kind),
]


def kind_of(given: Given) -> type[Cells | Sliced | Sheet | SlicedSheet | CustomStructure | Drawn]:
    """The kind of lattice that values mean."""
    if given.get("kind") == CUSTOM:
        return CustomStructure
    if given.get("kind") == DRAWN:
        return Drawn
    if given.get("slicer") is None:
        return Sheet if given.get("kind") in SHEETS else Cells
    return SlicedSheet if given.get("pattern") in SHEET_PATTERNS else Sliced
