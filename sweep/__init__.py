"""Crumple: which printed infill absorbs the most energy per gram.

    from sweep import load_config, expand, read_summary, read_history
    from sweep.simulation import simulate
    from sweep.ranking import rank

Each name is loaded when it is first used, so that importing `sweep` costs next to nothing.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sweep.config.units import load_config
    from sweep.config.grid import expand
    from sweep.ranking.rank import rank
    from sweep.simulation.simulate import simulate
    from sweep.store.read import read_history, read_summary

__all__ = ["expand", "load_config", "rank", "read_history", "read_summary", "simulate"]

_HOME = {
    "load_config": "sweep.config.units",
    "expand": "sweep.config.grid",
    "simulate": "sweep.simulation.simulate",
    "read_summary": "sweep.store.read",
    "read_history": "sweep.store.read",
    "rank": "sweep.ranking.rank",
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
