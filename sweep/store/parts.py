"""Sealed parts beside a results file: names, order, and files that survive a kill.

Part `FIRST-LAST.h5` holds the batches FIRST to LAST, which are numbered through the life of the
results file. Parts 1-1 to 64-64 are merged into 1-64, which covers them: if a kill interrupts their
deletion, no batch is read twice.
"""

import errno
import os
import re
import time
from contextlib import suppress
from io import FileIO
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from sweep.store.errors import StoreError

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

MERGE_AT = 64  # parts of one size that are merged; so there are never more than a few hundred
MOMENT, LONGEST = 0.1, 2.0  # seconds between two attempts to replace a file, and for all of them
NO_FSYNC = {errno.EINVAL, errno.EOPNOTSUPP}  # for folders on some network file systems

_NAME = re.compile(r"(\d{1,18})-(\d{1,18})\.h5")
_TEMPORARY = ".tmp"


class Part(NamedTuple):
    """A sealed file, and the numbers of its first and last batch."""

    first: int
    last: int
    path: Path

    @property
    def size(self) -> int:
        """Number of batches."""
        return self.last - self.first + 1


def parts_folder(path: Path) -> Path:
    """Folder of the parts of a results file."""
    path = target(path)
    return path.parent / f"{path.stem}.parts"


def target(path: Path) -> Path:
    """The file that a name refers to: links are followed, so that it has one lock and one folder of
    parts under all of its names.
    """
    return Path(os.path.realpath(path)) if path.is_symlink() else path


def new_part(path: Path, first: int, last: int) -> Part:
    """The part of the results file `path` for these batches; it is not written yet."""
    return Part(first, last, parts_folder(path) / f"{first:08d}-{last:08d}.h5")


def list_parts(path: Path) -> list[Part]:
    """Parts of a results file in order, without parts that a merged one covers."""
    parts: list[Part] = []
    for part in sorted(_list_all(path), key=lambda part: (part.first, -part.last)):
        if not parts or part.last > parts[-1].last:
            parts.append(part)
    return parts


def too_many(parts: list[Part]) -> bool:
    """Whether the parts should be merged, since a reader holds all of them open."""
    return len(parts) >= MERGE_AT


def parts_to_merge(parts: list[Part]) -> list[Part]:
    """The last `MERGE_AT` parts if they are of one size, else none."""
    tail = [part for part in parts[-MERGE_AT:] if part.size == parts[-1].size]
    return tail if len(tail) == MERGE_AT else []


class Unsealed(FileIO):
    """A file that gets its final name only when it is safe on the disk.

    HDF5 crashes on an error of the disk, so the error is kept and raised after HDF5 has finished.
    """

    def __init__(self, target: Path) -> None:
        self._target, self._temporary = target, target.with_name(target.name + _TEMPORARY)
        self._error: OSError | None = None
        super().__init__(self._temporary, "w+")

    def write(self, data: "ReadableBuffer", /) -> int:
        """Write all of `data`; after an error, only report that it is written."""
        rest = memoryview(data)
        try:
            while rest and self._error is None:
                rest = rest[super().write(rest) :]
        except OSError as error:
            self._error = error
        return memoryview(data).nbytes

    def truncate(self, size: int | None = None, /) -> int:
        """Set the size of the file; an error is kept for later."""
        try:
            return super().truncate(size)
        except OSError as error:
            self._error = self._error or error
        return size or 0

    def raise_error(self) -> None:
        """Raise the first error, if there is one."""
        if self._error is not None:
            raise self._error

    def seal(self) -> None:
        """Synchronise the file and give it its final name."""
        self.raise_error()
        os.fsync(self.fileno())
        self.close()
        _replace(self._temporary, self._target)
        _synchronise(self._target.parent)

    def abandon(self) -> None:
        """Delete the file, unless it is sealed."""
        self.close()
        self._temporary.unlink(missing_ok=True)


def make_folder(folder: Path) -> None:
    """Make a folder that survives a power cut."""
    if not folder.is_dir():
        folder.mkdir(parents=True, exist_ok=True)
        _synchronise(folder.parent)


def discard(parts: list[Part]) -> None:
    """Delete parts whose batches are stored elsewhere.

    A part that Windows keeps, as a reader has it open, is left to the next run.
    """
    for part in parts:
        with suppress(PermissionError):
            part.path.unlink(missing_ok=True)


def clear_leftovers(path: Path, folded: int) -> None:
    """Delete the remains of a killed writer: temporary files, and parts stored elsewhere."""
    needed = {part for part in list_parts(path) if part.last > folded}
    path.with_name(path.name + _TEMPORARY).unlink(missing_ok=True)
    for temporary in parts_folder(path).glob("*.h5" + _TEMPORARY):
        if _NAME.fullmatch(temporary.name.removesuffix(_TEMPORARY)):
            temporary.unlink()
    discard([part for part in _list_all(path) if part not in needed])


def remove_folder(path: Path) -> None:
    """Remove the folder of the parts if it is empty."""
    folder = parts_folder(path)
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()


def _list_all(path: Path) -> list[Part]:
    """The parts beside a results file, in any order; a link in place of one is refused."""
    folder = parts_folder(path)
    _refuse_link(folder)
    names = os.listdir(folder) if folder.is_dir() else []
    matches = [match for name in names if (match := _NAME.fullmatch(name))]
    parts = [Part(int(match[1]), int(match[2]), folder / match[0]) for match in matches]
    for part in parts:
        _refuse_link(part.path)
    return parts


def _refuse_link(path: Path) -> None:
    """Refuse a link: it leads to a file outside the results, which must not be deleted with the
    parts.
    """
    if path.is_symlink():
        raise StoreError(f"{path} is a link: remove it; allowed: what a run has written there.")


def _replace(source: Path, target: Path) -> None:
    """Rename a file. Windows refuses while a reader has the target open, so retry for a moment."""
    due = time.monotonic() + LONGEST
    while True:
        try:
            return os.replace(source, target)
        except PermissionError:
            if time.monotonic() > due:
                raise
            time.sleep(MOMENT)


def _synchronise(folder: Path) -> None:
    """Write the names in a folder to the disk, where the system can (Windows cannot)."""
    if not hasattr(os, "O_DIRECTORY"):
        return
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in NO_FSYNC:
            raise
    finally:
        os.close(descriptor)
