"""Crumple: which printed infill absorbs the most energy per gram.

    from sweep import load_config, expand, simulate, read_summary, read_history, rank

Each name is loaded when it is first used, so that importing `sweep` costs next to nothing.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sweep.config import load_config
    from sweep.grid import expand
    from sweep.rank import rank
    from sweep.simulate import simulate
    from sweep.store import read_history, read_summary

__all__ = ["expand", "load_config", "rank", "read_history", "read_summary", "simulate"]

_HOME = {
    "load_config": "sweep.config",
    "expand": "sweep.grid",
    "simulate": "sweep.simulate",
    "read_summary": "sweep.store",
    "read_history": "sweep.store",
    "rank": "sweep.rank",
}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'sweep' has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)


class _Package(ModuleType):
    """The package, whose `rank` and `simulate` stay functions though modules have their names."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _HOME and isinstance(value, ModuleType):
            value = getattr(value, name)  # importing `sweep.rank` would bind the module here
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
