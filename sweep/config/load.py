"""Reads the TOML file of a sweep, and expands it into its cases, once."""

import re
import tomllib
from dataclasses import replace
from difflib import get_close_matches
from os import PathLike
from pathlib import Path
from typing import Any

from sweep.config.faults import ConfigError, Fault, MisfitError
from sweep.config.grid import Config, expanded
from sweep.config.reading.examples import examples, find_config
from sweep.config.reading.reader import Reader, in_words, one_line
from sweep.config.reading.text import text_of
from sweep.config.units import in_si


def load_config(path: str | PathLike[str]) -> Config:
    """Read a sweep and check all of its cases; `ConfigError` holds all faults.

    path: path of a TOML file; if there is no such file, the name of an example, such as "smoke".
    """
    if not isinstance(path, str | PathLike):
        needed = "the path of a TOML file, or the name of an example"
        raise ConfigError([Fault("path", f"{in_words(path)} is no path; needed: {needed}")])
    path = find_config(path)
    reader = Reader(path.parent, in_si)
    config = reader.config(_document(path), path)
    try:
        cases, left_out = expanded(config.recipe)
        config = replace(config, cases=cases, left_out=left_out)
    except ConfigError as error:
        reader.faults += [fault for fault in error.faults if reader.trusts(fault)]
    if reader.faults:
        raise ConfigError(reader.faults)
    return config


def _document(path: Path) -> dict[str, Any]:
    """The TOML of a file."""
    try:
        text = text_of(path, f"a TOML file, or an example, such as {_nearest_examples(path)}")
        document = tomllib.loads(text)
        if document:
            return document
        wrong = "an empty config; `crumple new` writes a first one"
    except MisfitError as error:
        wrong = str(error)
    except tomllib.TOMLDecodeError as error:
        wrong = f"not TOML ({error}){_quoted_line(str(error), text)}"
    except (ValueError, RecursionError):
        wrong = "not TOML (a number too long, or nested too deeply)"
    raise ConfigError([Fault("path", f"{path}: {wrong}")])


def _nearest_examples(path: Path) -> str:
    """The examples whose names are nearest, or the usual ones."""
    return ", ".join(get_close_matches(path.stem, examples(), 3) or ("armor", "infills", "smoke"))


def _quoted_line(message: str, text: str) -> str:
    """The line of a text at which its parser gave up, shortened; nothing if it tells no line."""
    place = re.search(r"\(at (?:line (\d+)|end of document)", message)
    lines = text.rstrip().split("\n")
    if place is None:
        return ""
    number = min(int(place[1] or len(lines)), len(lines))
    line = one_line(lines[number - 1].strip())
    return f"; line {number}: {line if len(line) <= 60 else f'{line[:57]}...'}"
