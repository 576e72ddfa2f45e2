"""Writes the keys of a config as a JSON schema, with which an editor completes and checks them."""

from collections.abc import Mapping
from typing import Any

from sweep.config.keys import Key, case_keys, table_keys
from sweep.config.kinds.table import TABLES
from sweep.config.question import QUESTION
from sweep.config.reading.other_names import CHOICES

DIALECT = "http://json-schema.org/draft-07/schema#"  # the version that editors of TOML know best
OWN = {"unit", "bare", "bare_most", "title", "default"}
"""Entries of our schemas in SI that mean nothing to an editor."""
PROFILE = {
    "type": "string",
    "description": "the profile of a slicer, such as profile.ini, profile.json or project.3mf",
}
"""The path of a profile, which is no key of a case."""
ABOUT = {
    "grid": "all combinations of the values of its keys",
    "zip": "keys whose values go together",
    "exclude": "combinations of [grid] that are left out",
    "search": "what crumple optimize may choose: a list, or a range",
}

Schema = dict[str, Any]


def json_schema() -> Schema:
    """The schema of a whole config; the value of each key is among its definitions.

    In a grid, an empty text is the default of a key; in a search, a key has a list or a range.
    """
    keys = case_keys()
    all_keys = keys | {name: key for table in QUESTION for name, key in table_keys(table).items()}
    axes = {name: _list({"anyOf": [_defined(name), {"const": ""}]}) for name in keys}
    excluded = {name: {"anyOf": [_defined(name), _list(_defined(name))]} for name in keys}
    searched = {name: {"anyOf": [_list(_defined(name)), _range(key)]} for name, key in keys.items()}
    tables = {
        "name": {"type": "string", "description": "of the results file: results/NAME.h5"},
        **{table: _table(table, all_keys) for table in (*TABLES, *QUESTION)},
        "grid": _of_keys(axes | {"lattice.profile": _list(PROFILE)}),
        "zip": _list(_of_keys(axes)),
        "exclude": _list(_of_keys(excluded)),
        "search": _of_keys(searched),
    }
    return {
        "$schema": DIALECT,
        "title": "A sweep of Crumple",
        **_object(tables | {name: tables[name] | {"description": ABOUT[name]} for name in ABOUT}),
        "definitions": {name: _value(key) for name, key in all_keys.items()},
    }


def _table(table: str, keys: Mapping[str, Key]) -> Schema:
    """A table with the keys of all its kinds, and aliases."""
    own = [name for name in keys if name.startswith(f"{table}.")]
    profile = {"profile": PROFILE} if table == "lattice" else {}
    return _object({name.partition(".")[2]: _defined(name) for name in own} | profile)


def _value(key: Key) -> Schema:
    """A value of a key, as a config writes it."""
    one = _one(key)
    return (_list(one) if key.is_list else one) | {"description": key.allowed}


def _one(key: Key) -> Schema:
    """A single value, no list: for a quantity a text, and a number if its unit may be left out."""
    if key.unit:
        return {"type": ["string", "number"] if key.bare else "string"}
    schema = {name: entry for name, entry in key.schema.items() if name not in OWN}
    if "enum" not in schema:
        return schema
    words = [word for target in key.targets for word in CHOICES.get(target, ())]
    return schema | {"enum": [*schema["enum"], *words]}


def _range(key: Key) -> Schema:
    """A range of a search."""
    return _object({"from": _one(key), "to": _one(key)}) | {"required": ["from", "to"]}


def _defined(name: str) -> Schema:
    return {"$ref": f"#/definitions/{name}"}


def _of_keys(flat: Schema) -> Schema:
    """An object of dotted keys of a case, which TOML nests unless they are quoted."""
    nested: dict[str, Schema] = {table: {} for table in TABLES}
    for name, schema in flat.items():
        table, _, field = name.partition(".")
        nested[table][field] = schema
    return _object(flat | {table: _object(fields) for table, fields in nested.items()})


def _object(properties: Schema) -> Schema:
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _list(items: Schema) -> Schema:
    return {"type": "array", "items": items}
