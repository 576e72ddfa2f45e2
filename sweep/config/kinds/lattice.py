"""The kinds of lattice."""

from typing import Annotated, Any

from pydantic import Discriminator, Tag

from sweep.config.kinds.cells import CUSTOM, Cells
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.table import Given


def _kind(value: Any) -> str:
    """The kind of a lattice, or of its values."""
    fields = value if isinstance(value, dict) else getattr(value, "__dict__", {})
    return "custom" if "structure" in fields else "sliced" if "slicer" in fields else "cells"


Lattice = Annotated[
    Annotated[Cells, Tag("cells")]
    | Annotated[Sliced, Tag("sliced")]
    | Annotated[CustomStructure, Tag("custom")],
    Discriminator(_kind),
]


def kind_of(given: Given) -> type[Cells | Sliced | CustomStructure]:
    """The kind of lattice that values mean."""
    if given.get("kind") == CUSTOM:
        return CustomStructure
    return Cells if given.get("slicer") is None else Sliced
