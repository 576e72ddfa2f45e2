"""The kinds of lattice."""

from typing import Annotated, Any

from pydantic import Discriminator, Tag

from sweep.config.kinds.cells import Cells
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.sliced import Sliced


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
