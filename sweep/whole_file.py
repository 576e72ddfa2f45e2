"""Files that are written as a whole or not at all, also on a full disk."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A path beside ``path``, of the same name: the file written there is moved to its place when
    it is complete.

    A missing folder is made, and removed again if nothing is written.
    """
    path = path.resolve()
    new = [folder for folder in path.parents if not folder.exists()]
    path.parent.mkdir(parents=True, exist_ok=True)
    try:
        with TemporaryDirectory(prefix=".crumple-", dir=path.parent) as beside:
            file = Path(beside) / path.name
            yield file
            file.replace(path)
    finally:
        for folder in new:
            with suppress(OSError):  # it holds the file
                folder.rmdir()


def write_whole(path: Path, text: str) -> Path:
    """Write a text, in UTF-8, whose lines end alike on all systems."""
    with whole(path) as file:
        file.write_text(text, encoding="utf-8", newline="\n")
    return path
