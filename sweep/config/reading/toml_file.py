"""Reads a TOML file; a sentence says where it is wrong."""

import re
import tomllib
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from sweep.config.faults import ConfigError, Fault, MisfitError, one_line
from sweep.config.reading.examples import examples
from sweep.config.reading.text import text_of


def document_in(path: Path) -> dict[str, Any]:
    """The tables of a TOML file."""
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
    """The examples with the most similar names, or the usual ones."""
    return ", ".join(get_close_matches(path.stem, examples(), 3) or ("armor", "infills", "smoke"))


def _quoted_line(message: str, text: str) -> str:
    """The line of a text at which its parser failed, shortened; empty if the message names no
    line.
    """
    place = re.search(r"\(at (?:line (\d+)|end of document)", message)
    lines = text.rstrip().split("\n")
    if place is None:
        return ""
    number = min(int(place[1] or len(lines)), len(lines))
    line = one_line(lines[number - 1].strip())
    return f"; line {number}: {line if len(line) <= 60 else f'{line[:57]}...'}"
