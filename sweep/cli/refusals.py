"""Errors that end a command; their text is all that it prints."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from sweep.config.faults import ReportedError


class ArgumentError(ReportedError, ValueError):
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
    """The classes of these errors; the kernels, which import nothing of ours, have their own."""
    ours = ReportedError, ModuleNotFoundError
    with suppress(ModuleNotFoundError):  # where results are only read
        from kernels.compile.choice import CompilerError

        return (*ours, CompilerError)
    return ours
