"""The keys of a config: the values that each key accepts, in words, and the key nearest to a typo.

All of it is derived from the kinds of the tables, so that a new key needs no second entry.
"""

import difflib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from math import inf
from typing import Any, Literal

from pydantic import ConfigDict, TypeAdapter

from sweep.config import drop_tests
from sweep.config.kinds.contact import Barrier
from sweep.config.kinds.damping import KelvinVoigt, Rayleigh
from sweep.config.kinds.direction import Direction
from sweep.config.kinds.lattice import KINDS as LATTICES
from sweep.config.kinds.lattice import WORDS
from sweep.config.kinds.loading import BY_MODE
from sweep.config.kinds.loading import KINDS as LOADINGS
from sweep.config.kinds.material import Material
from sweep.config.kinds.solver import Arcs, Integrator, InTime, Static
from sweep.config.kinds.table import COMPUTED, TABLES, Table
from sweep.config.materials import material_file
from sweep.config.question import QUESTION
from sweep.config.units import QUANTITIES
from sweep.numbers import in_unit

KINDS: dict[str, tuple[type[Table], ...]] = {
    "lattice": LATTICES,
    "material": (Material,),
    "loading": BY_MODE,
    "contact": (Barrier,),
    "damping": (Rayleigh, KelvinVoigt),
    "solver": (InTime, Static, Arcs),
}
"""The kinds of a table, whose keys a config may set."""

CHOICES: dict[str, Any] = {
    "lattice.pattern": str,
    "lattice.kind": Literal[*WORDS],
    "loading.mode": Literal[*(word for kind in LOADINGS for word in kind.words)],
    "loading.direction": Direction,
    "loading.platen": Literal["none", "contact", "glued", "sliding", "clamped"],
    "contact.model": Literal["auto", "none", "barrier", "position_based"],
    "damping.model": Literal["none", "rayleigh", "kelvin_voigt"],
    "solver.integrator": Integrator,
}
"""The choices of keys that select a kind, or of which a kind has only some."""

ALIASES = {
    "lattice.cells": ("lattice.cells_x", "lattice.cells_y"),
    "lattice.extrusion_width": ("lattice.line_width",),
    "loading.load_steps": ("solver.load_steps",),
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

    targets: the keys of a case that it sets. unit: its SI unit. bare: the unit may be left out, for
    numbers up to ``bare_most``. allowed: the accepted values in words. schema: JSON schema of a
    value in SI, or of an item of a list. adapter: checks a value in SI.
    """

    targets: tuple[str, ...]
    unit: str | None
    bare: bool
    bare_most: float
    is_list: bool
    allowed: str
    schema: dict[str, Any]
    adapter: TypeAdapter[Any]

    def allowed_for(self, raw: object) -> str:
        """The accepted values in words, with bounds in percent if the value is."""
        if self.bare and not self.is_list and isinstance(raw, str) and "%" in raw:
            return _words(self.schema | {"bare": False})
        return self.allowed


@cache
def case_keys() -> dict[str, Key]:
    """The keys of a case by their dotted names, including aliases."""
    keys = {name: key for table in TABLES for name, key in table_keys(table).items()}
    return keys | {
        alias: replace(keys[targets[0]], targets=targets) for alias, targets in ALIASES.items()
    }


@cache
def table_keys(table: str) -> dict[str, Key]:
    """The keys of one table by their dotted names."""
    keys: dict[str, Key] = {}
    for kind in KINDS.get(table) or (QUESTION[table],):
        schemas = kind.model_json_schema()["properties"]
        for field, info in kind.model_fields.items():
            name = f"{table}.{field}"
            if name not in keys and name not in CHOICES and COMPUTED not in info.metadata:
                keys[name] = _key(name, info.rebuild_annotation(), schemas[field])
    chosen = {name: choices for name, choices in CHOICES.items() if name.startswith(f"{table}.")}
    return keys | {name: _key(name, choices) for name, choices in chosen.items()}


def nearest(name: str, candidates: Iterable[str]) -> str:
    """The known name most similar to this one; names that begin with it come first."""
    names = list(candidates)
    longer = [other for other in names if other.startswith(name)]
    return difflib.get_close_matches(name, longer or names, n=1, cutoff=0.0)[0]


def _key(name: str, kind: Any, schema: dict[str, Any] | None = None) -> Key:
    adapter = TypeAdapter(kind, config=ConfigDict(strict=True, allow_inf_nan=False))
    schema = _plain(schema or adapter.json_schema())
    is_list = schema.get("type") == "array"
    item = _item(schema) if is_list else schema
    allowed = _words(schema)
    if name == "material.name":
        allowed = material_file.in_words()
    if name == "loading.preset":
        allowed = drop_tests.in_words()
    unit, bare, most = item.get("unit"), item.get("bare", False), item.get("bare_most", inf)
    return Key((name,), unit, bare, most, is_list, allowed, item, adapter)


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
        return one_of(schema.get("enum", [schema.get("const")]))
    if schema["type"] == "array":
        length = f"{schema['maxItems']} values" if "maxItems" in schema else "values"
        return f"a list of {length}, each {_words(_item(schema))}"
    if schema["type"] == "boolean":
        return "true or false"
    if schema["type"] == "string":
        return "text"
    bounds = [
        f"{words} {_bound(schema[name], schema)}"
        for name, words in _BOUNDS.items()
        if name in schema
    ]
    noun = "a whole number" if schema["type"] == "integer" else "a number"
    noun += f" up to {schema['bare_most']:g}" if "bare_most" in schema else ""
    nouns = [noun] if schema.get("bare") or "unit" not in schema else []
    nouns += [QUANTITIES[schema["unit"]]] if "unit" in schema else []
    return ", ".join([" or ".join(nouns), *bounds])


def one_of(words: Iterable[str | int]) -> str:
    """Words in quotes, or numbers: "a", "b" or "c"; 60 or 180."""
    *others, last = [f'"{word}"' if isinstance(word, str) else str(word) for word in words]
    return f"{', '.join(others)} or {last}" if others else last


def _bound(value: float, schema: dict[str, Any]) -> str:
    """A bound in the unit in which the value has to be given."""
    unit = schema.get("unit", "1")
    if unit == "1" and "unit" in schema and not schema.get("bare"):
        return f"{in_unit(value, '%'):g} %" if value else "0"
    return f"{value:g} {unit}" if value and unit != "1" else f"{value:g}"
