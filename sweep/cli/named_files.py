"""Finds results files by the names that users give: their path, a sweep, or its config."""

import tomllib
from pathlib import Path

from sweep.config.faults import MisfitError

FOLDER = "results"  # folder of the files that `run` writes


def results_file(text: str) -> str:
    """The path of the results file that ``text`` refers to.

    It is the file itself; or NAME.h5, or results/NAME.h5 as `run` writes it, for the name or the
    config of a sweep.
    """
    path = Path(text)
    if path.suffix == ".toml":
        return f"{FOLDER}/{_name_in(path)}.h5"
    if path.suffix == ".h5" or path.is_file():
        return text
    beside, of_run = f"{text}.h5", f"{FOLDER}/{path.name}.h5"
    if path.exists() and not Path(of_run).is_file():
        return text
    return beside if Path(beside).is_file() else of_run


def _name_in(config: Path) -> str:
    """The name that a config states, else the name of its file."""
    from sweep.config.reading.text import text_of

    try:
        name = tomllib.loads(text_of(config, "a TOML file")).get("name")
    except (MisfitError, ValueError, RecursionError):
        name = None
    return name if isinstance(name, str) and name == Path(name).name else config.stem
