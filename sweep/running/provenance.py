"""Attributes of a results file about the run that wrote it."""

import json
import subprocess
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from platform import platform, python_version
from typing import Any

from kernels.compile.choice import compiler
from sweep.config.axis import Choice, Interval, Written
from sweep.config.grid import Config
from sweep.version import installed_version

PACKAGES = ("crumple", "numpy", "numba", "h5py", "distributed")


def describe_run(config: str) -> dict[str, str]:
    """Attributes of a results file; `config` is the resolved configuration as text."""
    versions = {f"version_{name}": installed_version(name) for name in PACKAGES}
    return {
        "config": config,
        "seed": "none: nothing in a case is random",
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "git_revision": git_revision(),
        "platform": platform(),
        "compiler": compiler(),
        "version_python": python_version(),
    } | versions


def config_text(config: Config) -> str:
    """A sweep as JSON, in SI: given values, axes, [rank], [require]."""
    recipe = config.recipe
    text: dict[str, Any] = {
        "name": config.name,
        "base": {key: written.value for key, written in recipe.base.items()},
        "grid": _axes(recipe.grid),
        "zip": [_axes(tied) for tied in recipe.zip],
        "exclude": recipe.exclude,
        "rank": config.rank.model_dump(),
        "require": config.require.model_dump(),
    }
    if recipe.search:
        text |= {"search": _searched(recipe.search), "search_seed": config.seed}
    return json.dumps(text)


def _searched(axes: Mapping[str, Interval | Choice]) -> dict[str, Any]:
    """The values that a search may choose: both ends, or a list."""
    return {
        key: {"from": axis.low, "to": axis.high}
        if isinstance(axis, Interval)
        else [written.value for written in axis.values]
        for key, axis in axes.items()
    }


@cache
def git_revision() -> str:
    """Commit of the source tree, with "-dirty" if files differ from it; "unknown" if installed.

    It is read only once, as later changes do not affect the modules that are loaded.
    """
    root = Path(__file__).parents[2]
    if not (root / ".git").exists():  # installed; a parent folder may be another repository
        return "unknown"
    command = ["git", "-C", str(root), "describe", "--always", "--dirty", "--abbrev=40"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=5, check=True)
    except (OSError, subprocess.SubprocessError):
        return "unknown"
    return done.stdout.strip()


def _axes(axes: Mapping[str, Sequence[Written]]) -> dict[str, list[Any]]:
    return {key: [value.value for value in values] for key, values in axes.items()}
