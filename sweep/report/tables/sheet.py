"""A table of text, for a terminal, a page or a file."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple


class Sheet(NamedTuple):
    """A table of text. opens: rows that begin a section. notes: lines below the table. spare: heads
    of columns that a narrow terminal may leave out, the first one first; elsewhere: which output
    still has them. cases: ids of the designs in the rows, if each row is one.
    """

    title: str
    heads: list[str]
    rows: list[list[str]]
    opens: frozenset[int] = frozenset()
    notes: tuple[str, ...] = ()
    spare: tuple[str, ...] = ()
    elsewhere: str = ""
    cases: tuple[str, ...] = ()

    @classmethod
    def of(cls, title: str, columns: Mapping[str, Iterable[str]], **more: Any) -> "Sheet":
        """A table from its columns, by their heads."""
        rows = [list(row) for row in zip(*columns.values(), strict=True)]
        return cls(title, list(columns), rows, **more)

    def without(self, head: str) -> "Sheet":
        """The table without a column."""
        k = self.heads.index(head)
        heads, *rows = [[*texts[:k], *texts[k + 1 :]] for texts in [self.heads, *self.rows]]
        return self._replace(heads=heads, rows=rows)

    @property
    def columns(self) -> list[list[str]]:
        """The texts below each head."""
        return [[row[i] for row in self.rows] for i in range(len(self.heads))]
