"""The cases of a sweep, each made when it is requested."""

from collections.abc import Iterable, Iterator, KeysView, Mapping, Sequence
from typing import Any, NamedTuple, overload

from sweep.config.case import Case
from sweep.config.kinds.lattice import Lattice
from sweep.config.kinds.table import TABLES, Table, keys_of

OTHERS = tuple(name for name in TABLES if name != "lattice")


class _Shared(NamedTuple):
    """Data that many cases share: the kind of their lattices, the other tables, the names of the
    labels.
    """

    kind: type[Lattice]
    tables: tuple[Table, ...]
    labels: tuple[str, ...]


class Cases(Sequence[Case]):
    """Different cases, in order; of cases with the same id the last one counts.

    Of each case only the values of its lattice and of its labels are kept, in one tuple: 0.5 kB
    instead of 2 kB. The case itself is made anew whenever it is requested, in 15 us.
    """

    def __init__(self, cases: Iterable[Case] = ()) -> None:
        self._ids: list[str] = []
        self._rows: dict[str, tuple[Any, ...]] = {}
        self._shared: dict[Any, _Shared] = {}
        for case in cases:
            self.add(case)

    @property
    def ids(self) -> KeysView[str]:
        """Their ids, in order."""
        return self._rows.keys()

    @property
    def labels(self) -> Mapping[str, Mapping[str, Any]]:
        """Their labels, `Case.axes`, by id."""
        return _Labels(self._rows)

    def add(self, case: Case) -> None:
        """Add a case, or replace the one with its id."""
        kind = type(case.lattice)
        shared = _Shared(kind, tuple(getattr(case, name) for name in OTHERS), tuple(case.axes))
        shared = self._shared.setdefault((kind, shared.labels, *map(id, shared.tables)), shared)
        values = (getattr(case.lattice, name) for name in kind.model_fields)
        if case.case_id not in self._rows:
            self._ids.append(case.case_id)
        self._rows[case.case_id] = (shared, *values, *case.axes.values())

    def of(self, case_id: str) -> Case:
        """The case with an id."""
        return _case_of(case_id, self._rows[case_id])

    def only(self, ids: Iterable[str]) -> "Cases":
        """The cases with these ids, in their order."""
        some = Cases()
        some._rows = {case_id: self._rows[case_id] for case_id in ids}
        some._ids, some._shared = [*some._rows], self._shared
        return some

    def without(self, ids: Iterable[str]) -> "Cases":
        """All but the cases with these ids."""
        left_out = self.ids & ids
        kept = (case_id for case_id in self._ids if case_id not in left_out)
        return self.only(kept) if left_out else self

    @overload
    def __getitem__(self, place: int) -> Case: ...
    @overload
    def __getitem__(self, place: slice) -> "Cases": ...
    def __getitem__(self, place: int | slice) -> "Case | Cases":
        if isinstance(place, slice):
            return self.only(self._ids[place])
        return self.of(self._ids[place])

    def __iter__(self) -> Iterator[Case]:
        return map(_case_of, self._rows, self._rows.values())

    def __len__(self) -> int:
        return len(self._rows)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and [*self] == [*other]


class _Labels(Mapping[str, Mapping[str, Any]]):
    """The labels of cases by id, each made when it is requested."""

    def __init__(self, rows: Mapping[str, tuple[Any, ...]]) -> None:
        self._rows = rows

    def __getitem__(self, case_id: str) -> dict[str, Any]:
        return _labels(self._rows[case_id])

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)


def compact(cases: Iterable[Case]) -> Cases:
    """Cases as `Cases`."""
    return cases if isinstance(cases, Cases) else Cases(cases)


def _labels(row: tuple[Any, ...]) -> dict[str, Any]:
    names = row[0].labels
    return dict(zip(names, row[len(row) - len(names) :], strict=True))


def _case_of(case_id: str, row: tuple[Any, ...]) -> Case:
    """The case of a row, with its id, which takes longer to compute than the rest."""
    kind, others, _ = row[0]
    values = dict(zip(kind.model_fields, row[1:], strict=False))
    lattice = kind.model_construct(keys_of(kind), **values)
    tables = dict(zip(OTHERS, others, strict=True))
    case = Case.model_construct(keys_of(Case), lattice=lattice, **tables, axes=_labels(row))
    case.__dict__["case_id"] = case_id
    return case
