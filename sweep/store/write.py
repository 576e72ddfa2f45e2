"""The writer of a results file: seals batches as parts, merges parts, folds them into the file."""

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from sweep.result import Result
from sweep.store.batch import Block, block_of, newest_rows
from sweep.store.hdf5 import About, Growing, seal_blocks
from sweep.store.lock import exclusive
from sweep.store.parts import (
    Part,
    clear_leftovers,
    discard,
    list_parts,
    make_folder,
    new_part,
    parts_to_merge,
    remove_folder,
    target,
    too_many,
)
from sweep.store.read import StoreError, exists, folded_batches, is_labelled, open_whole
from sweep.store.sealed_file import open_sealed
from sweep.store.tables import Axes

ASIDE = "move it away; `crumple merge` brings its rows into any results file"


class WriteError(StoreError):
    """A results file, or its folder, to which the system does not let a run write."""


class Writer:
    """The only writer of a results file, from the beginning to the end of a `with` block.

    axes: case id -> grid values (dotted key -> value in SI) of every case of the sweep, in the
    order of the rows of the file. attributes: about the run (`provenance`).

    Appended results are sealed as a part and also added to the growing results file, so that
    little remains to be done at the end.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        axes: Axes | None = None,
        attributes: Mapping[str, Any] | None = None,
    ) -> None:
        self.path = target(Path(path))
        self._about = About(axes or {}, attributes or {})
        self._parts: list[Part] = []
        self._sealed: list[Part] = []
        self._growing: Growing | None = None
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        if self.path.suffix != ".h5":  # its parts would be in the folder of NAME.h5
            raise StoreError(f"{self.path} cannot be written: allowed are names that end in .h5.")
        with _writing(self.path), ExitStack() as stack:
            make_folder(self.path.parent)
            stack.enter_context(exclusive(self.path))
            folded = folded_batches(self.path)
            self._refuse_others(list_parts(self.path))
            clear_leftovers(self.path, folded)
            parts = list_parts(self.path)
            self._count(max([folded, *(part.last for part in parts)]))
            self._parts = [self._merged(parts)] if too_many(parts) else parts
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def append(self, results: Sequence[Result]) -> None:
        """Seal a batch as a part, which then survives a kill."""
        if not results:
            return
        number = self._about.last + 1
        part, block = new_part(self.path, number, number), self._block(results)
        with _writing(self.path):
            make_folder(part.path.parent)
            seal_blocks(part.path, [block], self._about, packed=False)
            self._sealed.append(part)
            self._count(number)
            self._file().add(block, np.arange(len(results)))
            self._merge()

    def fold(
        self, last: Sequence[Result] = (), files: Iterable[str | os.PathLike[str]] = ()
    ) -> None:
        """Bring all parts into the results file, and its rows into the order of `axes`.

        last: results that go into the file directly, without a part of their own. files: other
        results files whose rows it takes over; of two rows of a case, the row of the later file
        stays.
        """
        parts = [*self._parts, *self._sealed]
        with _writing(self.path), ExitStack() as stack:
            added = [block for file in files for block in open_whole(Path(file), stack)]
            added += [self._block(last)] if last else []
            if parts or added or not self._is_labelled():
                growing, self._growing = self._file(), None  # cannot be used again after a failure
                for block, rows in newest_rows(added):
                    growing.add(block, rows)
                growing.add_older(self._older(stack))
                stack.close()  # Windows replaces no file that is open
                growing.seal(self._about)
            discard(parts)
            remove_folder(self.path)
        self._parts, self._sealed = [], []

    def _refuse_others(self, parts: Sequence[Part]) -> None:
        """Refuse a part whose sweep has another name, unless parts of that name share a case."""
        ids, own, others = self._about.axes.keys(), {_name_of(self._about.attributes)}, {}
        for part in parts if ids else ():
            with ExitStack() as stack:
                block = open_sealed(part.path, stack)
                others[part.path] = name = _name_of(block.attributes)
                own |= set() if ids.isdisjoint(block.summary["case_id"]) else {name}
        for path, name in others.items():
            if name not in own:
                of = f"another sweep, {name}" if name else "another sweep"
                raise StoreError(f"{path} is a part of {of}: {ASIDE}.")

    def _block(self, results: Sequence[Result]) -> Block:
        return block_of(results, self._about.attributes.get("git_revision", ""))

    def _is_labelled(self) -> bool:
        config = self._about.attributes.get("config")
        return not exists(self.path) or is_labelled(self.path, self._about.axes, config)

    def _count(self, last: int) -> None:
        self._about = replace(self._about, last=last)

    def _file(self) -> Growing:
        if self._growing is None:
            self._growing = self._stack.enter_context(closing(Growing(self.path, packed=True)))
        return self._growing

    def _older(self, stack: ExitStack) -> list[Block]:
        """Blocks of the file and the parts that this writer reads; open until `stack` closes."""
        whole = [self.path] if self.path.exists() else []
        return [open_sealed(path, stack) for path in (*whole, *(p.path for p in self._parts))]

    def _merge(self) -> None:
        while parts := parts_to_merge(self._sealed):
            self._sealed[-len(parts) :] = [self._merged(parts)]

    def _merged(self, parts: list[Part]) -> Part:
        merged = new_part(self.path, parts[0].first, parts[-1].last)
        seal_blocks(merged.path, _one_by_one(parts), self._about, packed=True)
        discard(parts)
        return merged


def _one_by_one(parts: Iterable[Part]) -> Iterator[Block]:
    """The blocks of parts, each open until the next one: an open file takes some 5 MB."""
    for part in parts:
        with ExitStack() as stack:
            yield open_sealed(part.path, stack)


def _name_of(attributes: Mapping[str, Any]) -> str:
    """Name of the sweep of a file, by the config in its attributes; "" if it has none."""
    with suppress(ValueError, AttributeError):
        return str(json.loads(attributes.get("config", "")).get("name", ""))
    return ""


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise WriteError(f"{path} cannot be written: {error.strerror or error}.") from error
