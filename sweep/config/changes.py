"""Changes of the values of a case: which old values they replace, and which are computed anew."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from sweep.config.kinds.lattice import kind_of
from sweep.config.kinds.table import TABLES, Inputs, Table


def merged(tables: Mapping[str, Table], changes: Mapping[str, Inputs]) -> dict[str, dict[str, Any]]:
    """The values of the tables of a case with changes, by table and key.

    Another material has only the new values; so has another kind of lattice, and a loading of
    another mode, whose numerics are chosen anew. Values that follow from others are computed anew
    when the lattice or the direction changes.
    """
    values = {name: tables[name].inputs() for name in TABLES}
    values |= {name: {} for name in _renewed(values, changes)}
    for name, change in changes.items():
        for key, value in change.items():
            if value is not None:
                _drop(values[name], tables[name].overridden_by(key))
        values[name] |= change
    if _resized(changes):
        for name in ("lattice", "loading"):
            own, new = values[name], changes.get(name, {})
            for cause, keys in tables[name].sets.items():
                if own.get(cause):
                    _drop(own, (key for key in keys if key not in new))
    return values


def _renewed(values: Mapping[str, Inputs], changes: Mapping[str, Inputs]) -> Iterator[str]:
    """The tables for which only new values count."""
    after = {name: {**values[name], **changes.get(name, {})} for name in values}
    if kind_of(after["lattice"]) is not kind_of(values["lattice"]):
        yield "lattice"
    if after["material"]["name"] != values["material"]["name"]:
        yield "material"
    if after["loading"]["mode"] != values["loading"]["mode"]:
        yield from ("loading", "contact", "damping", "solver")


def _resized(changes: Mapping[str, Inputs]) -> bool:
    """Whether the walls or the pressed body may have another size."""
    others = changes.get("lattice") or changes.get("material")
    return bool(others) or "direction" in changes.get("loading", {})


def _drop(values: dict[str, Any], keys: Iterable[str]) -> None:
    for key in keys:
        values.pop(key, None)
