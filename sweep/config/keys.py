"""The keys of a config: which values each key accepts, in words, and the key nearest to a typo.

All of it is derived from the models in `tables`, so that a new key needs no second entry.
"""

import difflib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from math import inf
from typing import Any

from pydantic import ConfigDict, TypeAdapter

from sweep.config.case import TABLES
from sweep.config.defaults import drop_tests
from sweep.config.materials.material_file import available
from sweep.config.tables import QUESTION, Table

ALIASES = {
    "lattice.cells": ("lattice.cells_x", "lattice.cells_y"),
    "lattice.extrusion_width": ("lattice.line_width",),
    "loading.load_steps": ("solver.load_steps",),
}
RESOLVED = {
    "lattice.structure",
    "lattice.fill_distance",
    "material.curve_strain",
    "material.curve_stress",
    "material.uncertain",
}  # parts of a case that a config cannot set
QUANTITIES = {
    "m": 'a length with a unit, such as "0.8 mm"',
    "m^2": 'an area with a unit, such as "8 mm^2"',
    "s": 'a time with a unit, such as "0.2 s"',
    "1/s": 'a rate with a unit, such as "5 1/s"',
    "m/s": 'a speed with a unit, such as "100 mm/min"',
    "m/s^2": 'an acceleration with a unit, such as "80 g0", of standard gravity (g is a gram)',
    "N": 'a force with a unit, such as "10 N"',
    "J": 'an energy with a unit, such as "0.1 J"',
    "Pa": 'a stress with a unit, such as "12 MPa"',
    "kg": 'a mass with a unit, such as "25 g"',
    "1": 'a share in percent, such as "20 %"',
    "rad": 'an angle with a unit, such as "45 deg"',
    "kg/m^3": 'a density with a unit, such as "1190 kg/m^3"',
}
_BOUNDS = {
    "exclusiveMinimum": "above",
    "minimum": "at least",
    "exclusiveMaximum": "below",
    "maximum": "at most",
}


@dataclass(frozen=True)
class Key:
    """One key of a config.

    targets: the keys of a case that it sets. unit: its SI unit. bare: the unit may be left out, of
    numbers up to ``bare_most``. allowed: the accepted values in words. adapter: checks a value in
    SI.
    """

    targets: tuple[str, ...]
    unit: str | None
    bare: bool
    bare_most: float
    is_list: bool
    allowed: str
    adapter: TypeAdapter[Any]


@cache
def case_keys() -> dict[str, Key]:
    """The keys of a case by their dotted names, including aliases."""
    known = {name: key for table in TABLES for name, key in table_keys(table).items()}
    return known | {
        alias: replace(known[targets[0]], targets=targets) for alias, targets in ALIASES.items()
    }


@cache
def table_keys(table: str) -> dict[str, Key]:
    """The keys of one table by their dotted names."""
    model = (TABLES | QUESTION)[table]
    schema = model.model_json_schema()["properties"]
    names = {field: f"{table}.{field}" for field in schema}
    return {
        name: _key(name, model, field, _plain(schema[field]))
        for field, name in names.items()
        if name not in RESOLVED
    }


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name most similar to this one; names that begin with it come first."""
    names = list(known)
    begun = [other for other in names if other.startswith(name)]
    return difflib.get_close_matches(name, begun or names, n=1, cutoff=0.0)[0]


def _key(name: str, model: type[Table], field: str, schema: dict[str, Any]) -> Key:
    is_list = schema.get("type") == "array"
    item = _item(schema) if is_list else schema
    allowed = _words(schema)
    if name == "material.name":
        allowed = f"{', '.join(available())}, or the path of a .csv file"
    if name == "loading.preset":
        allowed = drop_tests.in_words()
    info = model.model_fields[field]
    config = ConfigDict(strict=True, allow_inf_nan=False)
    adapter = TypeAdapter(info.rebuild_annotation(), config=config)
    unit, bare, most = item.get("unit"), item.get("bare", False), item.get("bare_most", inf)
    return Key((name,), unit, bare, most, is_list, allowed, adapter)


def _plain(schema: dict[str, Any]) -> dict[str, Any]:
    """The schema of a value, without the alternative null."""
    options = schema.get("anyOf", [])
    return next((option for option in options if option["type"] != "null"), schema)


def _item(schema: dict[str, Any]) -> dict[str, Any]:
    """The schema of the items of a list."""
    item: dict[str, Any] = schema["prefixItems"][0] if "prefixItems" in schema else schema["items"]
    return item


def _words(schema: dict[str, Any]) -> str:
    """The values that a schema accepts, in words."""
    if "enum" in schema or "const" in schema:
        *others, last = [f'"{name}"' for name in schema.get("enum", [schema.get("const")])]
        return f"{', '.join(others)} or {last}" if others else last
    if schema["type"] == "array":
        length = f"{schema['maxItems']} values" if "maxItems" in schema else "values"
        return f"a list of {length}, each {_words(_item(schema))}"
    if schema["type"] == "boolean":
        return "true or false"
    if schema["type"] == "string":
        return "text"
    unit = f" {schema['unit']}" if schema.get("unit", "1") != "1" else ""
    bounds = [
        f"{words} {schema[name]:g}{unit if schema[name] else ''}"
        for name, words in _BOUNDS.items()
        if name in schema
    ]
    noun = "a whole number" if schema["type"] == "integer" else "a number"
    noun += f" up to {schema['bare_most']:g}" if "bare_most" in schema else ""
    nouns = [noun] if schema.get("bare") or "unit" not in schema else []
    nouns += [QUANTITIES[schema["unit"]]] if "unit" in schema else []
    return ", ".join([" or ".join(nouns), *bounds])
