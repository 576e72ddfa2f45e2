"""Converts a config that is a Python dict into the form of a TOML document."""

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from typing import Any

from sweep.config.faults import ConfigError, Fault, in_words
from sweep.config.kinds.table import TABLES
from sweep.config.question import QUESTION

NESTED = (*TABLES, *QUESTION)


def document_of(mapping: Mapping[str, Any]) -> dict[str, Any]:
    """The document of a mapping, which may name keys by dots: {"lattice.kind": "hex"}.

    Arrays, tuples and ranges become lists, numbers of NumPy numbers of Python, paths text. A key
    that is no text, or that two spellings set, raises a `ConfigError`.
    """
    document: dict[str, Any] = {}
    for name, value in mapping.items():
        if not isinstance(name, str):
            raise _fault(str(name), value, "the name is no text; needed: a key such as lattice")
        table, dot, key = name.partition(".")
        if dot and table in NESTED:
            _add(document, table, {key: _plain(value)})
        elif name in NESTED and isinstance(value, Mapping):
            _add(document, name, _plain(value))
        else:
            document[name] = _plain(value)
    return document


def _add(document: dict[str, Any], table: str, values: dict[str, Any]) -> None:
    """Add keys to a table of a document."""
    section = document.setdefault(table, {})
    for key, value in values.items():
        if key in section:
            name = f"{table}.{key}"
            raise _fault(name, value, "set twice; allowed: in the table or by dots")
        section[key] = value


def _plain(value: Any) -> Any:
    """A value as a TOML file could hold it, as far as it could."""
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, PathLike):
        return fspath(value)
    if hasattr(value, "tolist"):  # arrays, and their numbers
        return _plain(value.tolist())
    if isinstance(value, Sequence) and not isinstance(value, str | bytes):
        return [_plain(each) for each in value]
    return value


def _fault(name: str, value: Any, wrong: str) -> ConfigError:
    return ConfigError([Fault(name, f"{name} = {in_words(value)}: {wrong}")])
