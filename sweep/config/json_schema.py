"""Writes the keys of a config as a JSON schema, with which an editor completes and checks them."""

from collections.abc import Callable, Mapping
from typing import Any

from sweep.config.keys import Key, case_keys, table_keys
from sweep.config.kinds.table import TABLES
from sweep.config.question import QUESTION
from sweep.config.reading.other_names import CHOICES

DIALECT = "http://json-schema.org/draft-07/schema#"  # the version that editors of TOML know best
OWN = {"unit", "bare", "bare_most", "title", "default"}
"""Entries of our schemas in SI that mean nothing to an editor."""
PROFILE = "the profile of a slicer, such as profile.ini, profile.json or project.3mf"
ABOUT = {
    "grid": "all combinations of the values of its keys",
    "zip": "keys whose values go together",
    "exclude": "combinations of [grid] that are left out",
    "search": "what crumple optimize may choose: a list, or a range",
}

Schema = dict[str, Any]


def json_schema() -> Schema:
    """The schema of a whole config; the value of each key is among its definitions."""
    keys = {name: key for table in QUESTION for name, key in table_keys(table).items()}
    keys = case_keys() | keys
    return {
        "$schema": DIALECT,
        "title": "A sweep of Crumple",
        **_object(
            {"name": {"type": "string", "description": "of the results file: results/NAME.h5"}}
            | {table: _table(table, keys) for table in (*TABLES, *QUESTION)}
            | {"grid": _of_keys(_axis, _list(_profile())) | {"description": ABOUT["grid"]}}
            | {"zip": _list(_of_keys(_axis)) | {"description": ABOUT["zip"]}}
            | {"exclude": _list(_of_keys(_choice)) | {"description": ABOUT["exclude"]}}
            | {"search": _of_keys(_searched) | {"description": ABOUT["search"]}}
        ),
        "definitions": {name: _value(key) for name, key in keys.items()},
    }


def _table(table: str, keys: Mapping[str, Key]) -> Schema:
    """A table with the keys of all its kinds, and aliases."""
    own = [name for name in keys if name.startswith(f"{table}.")]
    profile = {"profile": _profile()} if table == "lattice" else {}
    return _object({name.partition(".")[2]: _defined(name) for name in own} | profile)


def _profile() -> Schema:
    """The path of a profile, which is no key of a case."""
    return {"type": "string", "description": PROFILE}


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


def _defined(name: str) -> Schema:
    return {"$ref": f"#/definitions/{name}"}


def _axis(name: str, key: Key) -> Schema:
    """The values of a key in a grid; an empty text is its default."""
    return _list({"anyOf": [_defined(name), {"const": ""}]})


def _choice(name: str, key: Key) -> Schema:
    """The value of a key that is excluded, or several."""
    return {"anyOf": [_defined(name), _list(_defined(name))]}


def _searched(name: str, key: Key) -> Schema:
    """The values of a key in a search: a list, or a range."""
    ends = _object({"from": _one(key), "to": _one(key)}) | {"required": ["from", "to"]}
    return {"anyOf": [_list(_defined(name)), ends]}


def _of_keys(written: Callable[[str, Key], Schema], profiles: Schema | None = None) -> Schema:
    """An object with all keys of a case, dotted, which TOML nests unless they are quoted; profiles:
    schema of the profile of a slicer.
    """
    flat = {name: written(name, key) for name, key in case_keys().items()}
    flat |= {"lattice.profile": profiles} if profiles else {}
    nested: dict[str, dict[str, Schema]] = {table: {} for table in TABLES}
    for name, schema in flat.items():
        table, _, field = name.partition(".")
        nested[table][field] = schema
    return _object(flat | {table: _object(fields) for table, fields in nested.items()})


def _object(properties: Schema) -> Schema:
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _list(items: Schema) -> Schema:
    return {"type": "array", "items": items}
