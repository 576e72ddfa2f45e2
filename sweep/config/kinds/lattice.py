"""The kinds of lattice, and the choice of the kind from given values."""

from typing import Annotated, Any, TypeAlias, get_args

from pydantic import GetPydanticSchema
from pydantic_core import core_schema

from sweep.config.kinds.cells import Cells
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.drawn import Drawn
from sweep.config.kinds.printable import check_printable
from sweep.config.kinds.sheet import Sheet
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.config.kinds.table import Inputs, RefusedError, keys_of
from sweep.config.kinds.upright import upright

Lattice: TypeAlias = Cells | Sliced | Sheet | SlicedSheet | CustomStructure | Drawn
KINDS: tuple[type[Lattice], ...] = get_args(Lattice)
TAGS = {kind.__name__: kind for kind in KINDS}
WORDS = tuple(word for kind in KINDS for word in kind.words)


def _tag(value: Any) -> str:
    """The kind of a lattice, or of its values by their keys."""
    keys = {*value} if isinstance(value, dict) else {*getattr(value, "__dict__", {})}
    return min(KINDS, key=lambda kind: len(kind.model_fields.keys() ^ keys)).__name__


AnyLattice = Annotated[
    Lattice,
    GetPydanticSchema(
        lambda _, schema_of: core_schema.tagged_union_schema(
            {tag: schema_of(kind) for tag, kind in TAGS.items()}, discriminator=_tag
        )
    ),
]
"""A lattice in a case, which JSON text holds without the name of its kind."""


def kind_of(inputs: Inputs) -> type[Lattice]:
    """The kind of lattice that values mean."""
    return next(kind for kind in reversed(KINDS) if kind.means(inputs))


def lattice_of(inputs: Inputs, density: float, along: bool) -> Lattice:
    """The lattice of these values; density (kg/m^3): of its material."""
    if inputs.get("kind", WORDS[0]) not in WORDS:
        raise RefusedError("lattice.kind", inputs["kind"], ", ".join(WORDS))
    kind = kind_of(inputs)
    try:
        lattice = kind.of(inputs, density, along)
    except RefusedError as error:
        error.also += [
            RefusedError(f"lattice.{key}", inputs[key], f"none, as {why}")
            for key, why in kind.idle(inputs).items()
        ]
        raise
    check_printable(lattice)
    if lattice.sheet:
        return lattice
    return upright(lattice, inputs) if along else _across(lattice)


def _across(lattice: Lattice) -> Lattice:
    """The lattice without values that only a crush along the cells uses.

    A sweep may have very many such lattices, so all share one set of keys.
    """
    return type(lattice).model_construct(keys_of(type(lattice)), **(dict(lattice) | lattice.across))
