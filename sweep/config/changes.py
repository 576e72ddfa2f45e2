"""Other values of a case: which of its own values they replace, and which are computed anew."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from sweep.config.kinds.lattice import kind_of
from sweep.config.kinds.table import TABLES, Given, Table

FALL = ("energy", "drop_height", "preset", "specimens")
REPLACED = {
    "loading.strain": ("stroke",),
    "loading.stroke": ("strain",),
    "loading.strain_rate": ("speed",),
    "loading.speed": ("strain_rate",),
    "loading.striker_speed": FALL,
    "loading.energy": ("striker_speed", "drop_height", "preset", "specimens"),
    "loading.drop_height": ("striker_speed", "energy", "preset", "specimens", "gravity"),
    "loading.striker_mass": ("energy", "preset", "specimens"),
    "loading.preset": ("striker_mass", "striker_speed", "energy", "drop_height", "gravity"),
    "loading.target_mass": ("gravity",),
    "loading.specimens": ("striker_mass", "energy"),
    "lattice.mass": ("wall_thickness", "infill", "line_distance"),
    "lattice.wall_thickness": ("mass", "infill"),
    "lattice.infill": (
        *("mass", "wall_thickness", "cells_x", "cells_y", "cell_size"),
        "line_distance",
    ),
    "lattice.line_distance": ("mass", "infill"),
    "lattice.file": ("structure", "drawing"),
    "lattice.file_unit": ("drawing",),
    "lattice.cell_size": ("infill", "cells_x", "cells_y"),
    "lattice.cells_x": ("infill", "cell_size"),
    "lattice.cells_y": ("infill", "cell_size"),
}
"""The keys of the same table that a new value of a key replaces."""

FOLLOWS = {
    "loading": (("stroke", "strain"), ("speed", "strain_rate")),
    "lattice": (
        ("wall_thickness", "mass"),
        ("wall_thickness", "infill"),
        ("cells_x", "infill"),
        ("cells_y", "infill"),
        ("cells_x", "cell_size"),
        ("cells_y", "cell_size"),
    ),
}
"""By table: a key that follows from another when the lattice or the direction changes."""


def merged(tables: Mapping[str, Table], changes: Mapping[str, Given]) -> dict[str, dict[str, Any]]:
    """The values of the tables of a case with changes, by table and key.

    Another material has only the new values; so has another kind of lattice, and a loading of
    another mode, whose numerics are chosen anew.
    """
    values = {name: tables[name].given() for name in TABLES}
    values |= {name: {} for name in _renewed(values, changes)}
    for name, change in changes.items():
        for key, value in change.items():
            if value is not None:
                _drop(values[name], REPLACED.get(f"{name}.{key}", ()))
        values[name] |= change
    if _resized(changes):
        for name, pairs in FOLLOWS.items():
            given, new = values[name], changes.get(name, {})
            _drop(given, [key for key, cause in pairs if given.get(cause) and key not in new])
    return values


def _renewed(values: Mapping[str, Given], changes: Mapping[str, Given]) -> Iterator[str]:
    """The tables of which only new values count."""
    after = {name: {**values[name], **changes.get(name, {})} for name in values}
    if kind_of(after["lattice"]) is not kind_of(values["lattice"]):
        yield "lattice"
    if after["material"]["name"] != values["material"]["name"]:
        yield "material"
    if after["loading"]["mode"] != values["loading"]["mode"]:
        yield from ("loading", "contact", "damping", "solver")


def _resized(changes: Mapping[str, Given]) -> bool:
    """Whether the walls or what is pressed may have another size."""
    others = changes.get("lattice") or changes.get("material")
    return bool(others) or "direction" in changes.get("loading", {})


def _drop(values: dict[str, Any], keys: Iterable[str]) -> None:
    for key in keys:
        values.pop(key, None)
