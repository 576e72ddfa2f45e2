"""Errors that end a command, with their text as all that it prints."""

import sys

HOME = __name__.removesuffix(".cli.refusals")
REFUSALS = {
    f"{HOME}.config.grid": "ConfigError",
    f"{HOME}.config.materials.material_file": "RecordError",
    f"{HOME}.coupon.record": "CouponError",
    f"{HOME}.cli.materials": "MaterialsError",
    f"{HOME}.cli.optimize": "OptimizeError",
    f"{HOME}.cli.find_case": "CaseError",
    f"{HOME}.cli.new": "NewError",
    f"{HOME}.store.read": "StoreError",
    f"{HOME}.export.errors": "ExportError",
    f"{HOME}.running.dask_graph": "GraphError",
    f"{HOME}.ranking.question": "RankError",
    f"{HOME}.ranking.accuracy": "AccuracyError",
    f"{HOME.rpartition('.')[0]}.kernels.compile.choice".lstrip("."): "CompilerError",
}


class ArgumentError(ValueError):
    """An argument that cannot be used."""


def refusals() -> tuple[type[Exception], ...]:
    """Error classes whose text says what is wrong with a config, a file or an argument.

    Only modules that are loaded are asked: no other module can have raised an error.
    """
    loaded = [(sys.modules[name], error) for name, error in REFUSALS.items() if name in sys.modules]
    ours = [getattr(module, error) for module, error in loaded]
    return (ArgumentError, ModuleNotFoundError, *ours)
