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
from sweep.config.case import Case
from sweep.config.grid import Config, Designs
from sweep.version import installed_version

PACKAGES = ("crumple", "numpy", "numba", "h5py", "dask")


def describe_run(config: str) -> dict[str, str]:
    """Attributes of a results file; `config`: as `config_text` returns it."""
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


def config_text(sweep: Config | Sequence[Case]) -> str:
    """A sweep as JSON, in SI: given values, axes, [rank], [require]; every row has its case."""
    text: dict[str, Any] = {}
    if isinstance(sweep, Config):
        text |= {
            "name": sweep.name,
            "base": {key: written.value for key, written in sweep.base.items()},
            "grid": _axes(sweep.grid),
            "zip": [_axes(tied) for tied in sweep.zip],
            "exclude": sweep.exclude,
            "rank": sweep.rank.model_dump(),
            "require": sweep.require.model_dump(),
        }
    if isinstance(sweep, Designs):
        text |= {"search": _searched(sweep.search), "search_seed": sweep.seed}
    return json.dumps(text)


def _searched(axes: Mapping[str, Interval | Choice]) -> dict[str, Any]:
    """What a search may choose: both ends, or a list."""
    return {
        key: {"from": axis.low, "to": axis.high}
        if isinstance(axis, Interval)
        else [written.value for written in axis.values]
        for key, axis in axes.items()
    }


@cache
def git_revision() -> str:
    """Commit of the source tree, with "-dirty" if files differ from it; "unknown" if installed.

    It is asked for once, as later changes are not those of the modules that are loaded.
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
