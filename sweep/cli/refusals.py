"""Errors that end a command; their text is all that it prints."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

HOME = __name__.removesuffix(".cli.refusals")
REFUSALS = {
    f"{HOME}.config.faults": "MisfitError",
    f"{HOME}.cli.materials": "MaterialsError",
    f"{HOME}.running.searching.optimize": "OptimizeError",
    f"{HOME}.cli.card": "CardError",
    f"{HOME}.cli.find_case": "CaseError",
    f"{HOME}.cli.new": "NewError",
    f"{HOME}.store.errors": "StoreError",
    f"{HOME}.export.errors": "ExportError",
    f"{HOME}.running.cluster": "ClusterError",
    f"{HOME}.ranking.question": "RankError",
    f"{HOME}.ranking.accuracy": "AccuracyError",
    f"{HOME.rpartition('.')[0]}.kernels.compile.choice".lstrip("."): "CompilerError",
}


class ArgumentError(ValueError):
    """An argument that cannot be used."""


@contextmanager
def writing(folder: Path, file: Path | None = None) -> Iterator[None]:
    """Refuse in one line to write into a folder that is not writable; file: the file to be
    written.
    """
    try:
        yield
    except (FileExistsError, NotADirectoryError) as error:
        raise ArgumentError(f"{folder} is or lies in a file; allowed: a folder") from error
    except OSError as error:
        why = os.strerror(error.errno) if error.errno else error  # h5py has a text of many lines
        raise ArgumentError(f"{file or folder} cannot be written: {why}") from error


def refusals() -> tuple[type[Exception], ...]:
    """Error classes whose text says what is wrong with a config, a file or an argument.

    Only loaded modules are searched: no other module can have raised an error.
    """
    loaded = [(sys.modules[name], error) for name, error in REFUSALS.items() if name in sys.modules]
    ours = [getattr(module, error) for module, error in loaded]
    return (ArgumentError, ModuleNotFoundError, *ours)
