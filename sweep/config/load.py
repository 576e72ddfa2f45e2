"""Loads the config of a sweep, a TOML file or a dict, and expands it into its cases, once."""

from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, TypeAlias, Unpack

from sweep.config.case import Case
from sweep.config.faults import ConfigError, Fault, in_words
from sweep.config.grid import Config, expanded
from sweep.config.kinds.table import TABLES, Tables
from sweep.config.reading.examples import find_config
from sweep.config.reading.mapping import document_of
from sweep.config.reading.reader import Reader
from sweep.config.reading.toml_file import document_in

Source: TypeAlias = str | PathLike[str] | Mapping[str, Any]
"""Where a config comes from: the path of a TOML file, the name of an example, or a dict."""


def load_config(path: Source) -> Config:
    """Read a sweep and check all of its cases; `ConfigError` holds all faults.

    path: path of a TOML file; if there is no such file, the name of an example, such as "smoke"; or
    a dict with the content of a file: {"lattice": {"width": "50 mm"}, "grid": {"lattice.kind":
    [...]}}. Quantities are text with a unit there too. Paths in a dict are relative to the current
    folder, and without a `name` it is "unnamed".
    """
    if isinstance(path, Mapping):
        document = document_of(path)
        if not document:
            needed = 'tables such as {"lattice": {"kind": "hex"}}'
            raise ConfigError([Fault("path", f"an empty config; needed: {needed}")])
        return _config(document, None)
    if not isinstance(path, str | PathLike):
        needed = "the path of a TOML file, the name of an example, or a dict"
        raise ConfigError([Fault("path", f"{in_words(path)} is no path; needed: {needed}")])
    path = find_config(path)
    return _config(document_in(path), path)


def case(**tables: Unpack[Tables]) -> Case:
    """One case of the given keys of a config, completed with defaults; `ConfigError` holds all
    faults.

    case(lattice={"kind": "hex", "width": "50 mm"}, loading={"mode": "displacement"}), or by dotted
    keys: case(**{"lattice.kind": "hex"}). Quantities are text with a unit; `Case.of` takes numbers
    in SI. Without any key it is the default case.
    """
    return case_of(tables)


def case_of(source: Case | Mapping[str, Any]) -> Case:
    """A `Case` itself, or the case of these tables of a config, as in `case`."""
    if isinstance(source, Case):
        return source
    if not isinstance(source, Mapping):
        needed = "a case of crumple.case, or a dict of its tables"
        raise ConfigError([Fault("case", f"{in_words(source)} is no case; needed: {needed}")])
    document = document_of({name: values for name, values in source.items() if values is not None})
    if other := [name for name in document if name not in TABLES]:
        allowed = f"the tables {', '.join(TABLES)}, or keys such as lattice.kind"
        line = f"{other[0]} = {in_words(document[other[0]])}: of no case; allowed: {allowed}"
        raise ConfigError([Fault(other[0], line)])
    (case,) = _config(document, None).cases
    return case


def _config(document: dict[str, Any], path: Path | None) -> Config:
    """The sweep of a document; path: of its file, if it has one."""
    reader = Reader(path.parent if path else Path())
    config = reader.config(document, path)
    notes = tuple(dict.fromkeys(reader.notes))
    try:
        cases, left_out = expanded(config.recipe)
        config = replace(config, cases=cases, left_out=left_out, notes=notes)
    except ConfigError as error:
        reader.faults += [fault for fault in error.faults if reader.trusts(fault)]
    if reader.faults:
        raise ConfigError(reader.faults, notes)
    return config
