"""The one writer of a results file: seals batches as parts, merges them, folds them in."""

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

from sweep.lock import LockedError, exclusive
from sweep.parts import (
    Part,
    clear_leftovers,
    discard,
    list_parts,
    make_folder,
    new_part,
    parts_to_merge,
    remove_folder,
)
from sweep.result import Result
from sweep.store import (
    About,
    Axes,
    StoreError,
    exists,
    folded_batches,
    is_labelled,
    seal_parts,
    seal_results,
    seal_union,
)


class Writer:
    """Writes into a results file, alone, from the beginning to the end of a `with` block.

    axes: case id -> grid values (dotted key -> value in SI) of every case of the sweep, in the
    order that the rows shall have. attributes: what to say about the run (sweep/provenance.py).
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        axes: Axes | None = None,
        attributes: Mapping[str, Any] | None = None,
    ) -> None:
        self.path = Path(path)
        self._about = About(axes or {}, attributes or {})
        self._parts: list[Part] = []
        self._held = ExitStack()

    def __enter__(self) -> Self:
        if self.path.suffix != ".h5":  # with another name it would share its parts with NAME.h5
            raise StoreError(f"{self.path} cannot be written: allowed are names that end in .h5.")
        with _writing(self.path), ExitStack() as held:
            make_folder(self.path.parent)
            held.enter_context(_only_writer(self.path))
            folded = folded_batches(self.path)
            clear_leftovers(self.path, folded)
            self._parts = list_parts(self.path)
            self._count(max([folded, *(part.last for part in self._parts)]))
            self._held = held.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._held.close()

    def append(self, results: Sequence[Result]) -> None:
        """Seal a batch as a part: from here on no kill can lose it."""
        if not results:
            return
        number = self._about.last + 1
        part = new_part(self.path, number, number)
        with _writing(self.path):
            make_folder(part.path.parent)
            seal_results(part.path, results, self._about)
            self._parts.append(part)
            self._count(number)
            self._merge()

    def fold(self) -> None:
        """Bring all parts into the one file, and its rows into the order of `axes`."""
        with _writing(self.path):
            if self._parts or (exists(self.path) and not is_labelled(self.path, self._about.axes)):
                seal_union(self.path, self._about)
            discard(self._parts)
            remove_folder(self.path)
        self._parts = []

    def _count(self, last: int) -> None:
        self._about = replace(self._about, last=last)

    def _merge(self) -> None:
        while parts := parts_to_merge(self._parts):
            merged = new_part(self.path, parts[0].first, parts[-1].last)
            seal_parts(merged.path, [part.path for part in parts], self._about)
            discard(parts)
            self._parts[-len(parts) :] = [merged]


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise StoreError(f"{path} cannot be written: {error.strerror or error}.") from error


@contextmanager
def _only_writer(path: Path) -> Iterator[None]:
    try:
        with exclusive(path.with_name(f".{path.name}.lock")):
            yield
    except LockedError as error:
        holder = f" (process {error.holder})" if error.holder else ""
        raise StoreError(f"Another run is writing into {path}{holder}.") from None
