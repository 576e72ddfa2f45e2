"""Sweeps of crushed lattices: configs, cases, results and files; and the public names of `crumple`.

The public functions raise `MisfitError`, whose kinds are `ConfigError` and `CouponError`,
`StoreError`, `RankError`, `ExportError`, `OptimizeError` and `ClusterError`, which are public too.
Each name is loaded when it is first used, so that `import sweep` takes almost no time.

Modules outside of the packages: `argument_types` explains wrong arguments of a call, `columns`
lists the columns of results, `loading_modes` the modes of loading, `result` has the result of one
case, `numbers` writes quantities as text, `plain_text` makes foreign texts safe, `constants` has
factors between units, `array_types` types of arrays, `version` the versions of installed packages.
"""

from importlib import import_module
from types import FunctionType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sweep.config.case import Case
    from sweep.config.faults import ConfigError, MisfitError
    from sweep.config.grid import Config, expand
    from sweep.config.load import case, load_config
    from sweep.coupon.materials import fit_material, materials
    from sweep.coupon.record import CouponError
    from sweep.effective.material import EffectiveMaterial, card
    from sweep.export.errors import ExportError
    from sweep.export.export import Exported, export_case
    from sweep.ranking.question import RankError
    from sweep.ranking.rank import rank, ranked
    from sweep.ranking.ranking import Ranking
    from sweep.result import Result, Status
    from sweep.results import Picture, Results
    from sweep.running.cluster import ClusterError
    from sweep.running.run import run, spread
    from sweep.running.searching.optimize import OptimizeError, optimize
    from sweep.running.sweep import Interrupted, run_sweep
    from sweep.simulation.simulate import simulate
    from sweep.store.read import (
        Rerun,
        StoreError,
        read_case,
        read_frames,
        read_history,
        read_summary,
    )
    from sweep.version import __version__

__all__ = [
    "Case",
    "ClusterError",
    "Config",
    "ConfigError",
    "CouponError",
    "EffectiveMaterial",
    "ExportError",
    "Exported",
    "Interrupted",
    "MisfitError",
    "OptimizeError",
    "Picture",
    "RankError",
    "Ranking",
    "Rerun",
    "Result",
    "Results",
    "Status",
    "StoreError",
    "__version__",
    "card",
    "case",
    "expand",
    "export_case",
    "fit_material",
    "load_config",
    "materials",
    "optimize",
    "rank",
    "ranked",
    "read_case",
    "read_frames",
    "read_history",
    "read_summary",
    "run",
    "run_sweep",
    "simulate",
    "spread",
]

_NAMES = {
    "config.case": "Case",
    "config.faults": "ConfigError MisfitError",
    "config.grid": "Config expand",
    "config.load": "case load_config",
    "coupon.materials": "fit_material materials",
    "coupon.record": "CouponError",
    "effective.material": "EffectiveMaterial card",
    "export.errors": "ExportError",
    "export.export": "Exported export_case",
    "ranking.question": "RankError",
    "ranking.rank": "rank ranked",
    "ranking.ranking": "Ranking",
    "result": "Result Status",
    "results": "Picture Results",
    "running.cluster": "ClusterError",
    "running.run": "run spread",
    "running.searching.optimize": "OptimizeError optimize",
    "running.sweep": "Interrupted run_sweep",
    "simulation.simulate": "simulate",
    "store.read": "Rerun StoreError read_case read_frames read_history read_summary",
    "version": "__version__",
}
"""The public names of each module."""
_HOME = {name: module for module, names in _NAMES.items() for name in names.split()}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"Crumple has no {name!r}; it has {', '.join(__all__)}")
    member = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    from sweep.argument_types import explained

    return explained(member) if isinstance(member, FunctionType) else member


def __dir__() -> list[str]:
    return __all__
