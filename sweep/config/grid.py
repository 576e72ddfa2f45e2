"""From a config to its cases: grid x zips, without excluded cases and duplicates."""

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from itertools import product
from math import prod
from pathlib import Path
from typing import Any, NamedTuple

from sweep.config.axis import Choice, Interval, Written
from sweep.config.case import TABLES, Case, Draft, cached, complete
from sweep.config.keys import ALIASES, KINDS, case_keys
from sweep.config.kinds.table import RefusedError, rounded
from sweep.config.materials.material_file import RecordError
from sweep.config.materials.material_header import KEYS
from sweep.config.question import Rank, Require
from sweep.config.reading.unused_keys import still_unused

MAX_CASES = 1_000_000
SHOWN = 10  # faults that the text of a ConfigError lists
_QUANTITY = re.compile(r'"([\d.eE+-]+)\s*(.+)"')
PRINTABLE = "lattice.printable"
OF_A_FILE = frozenset(f"material.{name}" for name in KEYS.values())
ONLY_OPTIMIZE = "only `crumple optimize` searches; allowed here: lists of values in [grid]"
MAY_BE_UNUSED = ("material.poisson",)  # a property of the material, stated even in plane stress


class Fault(NamedTuple):
    """One fault: its key, and one line with key, value and allowed values."""

    key: str
    line: str


class ConfigError(ValueError):
    """A config that cannot be run. `faults`: all faults; the text lists `SHOWN` of them."""

    def __init__(self, faults: list[Fault]) -> None:
        super().__init__("\n".join(_shown(faults)))
        self.faults = faults


def _shown(faults: list[Fault]) -> list[str]:
    """One line each for `SHOWN` faults; the first fault of every key goes before further ones."""
    seen: Counter[str] = Counter()
    repeats = []  # number of earlier faults of the same key
    for fault in faults:
        repeats.append(seen[fault.key])
        seen[fault.key] += 1
    chosen = sorted(range(len(faults)), key=repeats.__getitem__)[:SHOWN]
    more = len(faults) - len(chosen)
    counted = [f"and {more:,} more mistake{'s' if more > 1 else ''}"] if more else []
    return [faults[k].line for k in sorted(chosen)] + counted


Values = dict[str, Written]
Axes = dict[str, tuple[Written, ...]]


@dataclass(frozen=True)
class Config:
    """A sweep: the values that all cases share, and the axes that vary; keys are dotted.

    grid, zip: key -> values; every value of the grid meets every row of every zip.
    exclude: tables key -> rounded values. A case is dropped if, for every key of a table, its value
    is among the values of that key. search: key -> what a search may choose; a config with it has
    no cases but those that the search chooses.
    """

    name: str
    base: Values = field(default_factory=dict)
    grid: Axes = field(default_factory=dict)
    zip: tuple[Axes, ...] = ()
    exclude: tuple[dict[str, tuple[object, ...]], ...] = ()
    rank: Rank = field(default_factory=Rank)
    require: Require = field(default_factory=Require)
    path: Path | None = None
    search: dict[str, Interval | Choice] = field(default_factory=dict)

    @cached_property
    def _expanded(self) -> tuple[tuple[Case, ...], int]:
        cases, unprintable = _cases(self)
        return tuple(cases), unprintable

    @property
    def cases(self) -> tuple[Case, ...]:
        """The cases that `expand` returns, computed once."""
        if self.search:
            line = f"[search] of {', '.join(self.search)}: {ONLY_OPTIMIZE}"
            raise ConfigError([Fault("search", line)])
        return self._expanded[0]

    @property
    def unprintable(self) -> int:
        """Number of combinations that are left out, as they do not print (`lattice.printable`)."""
        return self._expanded[1]


@dataclass(frozen=True)
class Chosen(Config):
    """A sweep of which only some designs are to run."""

    designs: tuple[Case, ...] = ()

    @cached_property
    def cases(self) -> tuple[Case, ...]:
        """The designs."""
        return self.designs


@dataclass(frozen=True)
class Designs(Chosen):
    """The designs that a search has chosen so far, and its seed."""

    seed: int = 0


def chosen_of(config: Config, designs: Iterable[Case]) -> Chosen:
    """The config, of which only these designs are to run."""
    return Chosen(**_fields_of(config), designs=tuple(designs))


def designs_of(config: Config, designs: Iterable[Case], seed: int) -> Designs:
    """The config of a search, whose cases are these designs."""
    return Designs(**_fields_of(config), designs=tuple(designs), seed=seed)


def _fields_of(config: Config) -> dict[str, Any]:
    return {each.name: getattr(config, each.name) for each in fields(Config)}


def check(config: Config) -> None:
    """Refuse a config that cannot be run; a search is tried at a few points (`_combinations`)."""
    if config.search:
        _cases(config)
    else:
        expand(config)


def chosen_case(config: Config, chosen: Values) -> Case | None:
    """The case of a search with these values, in SI; None if they cannot be combined."""
    alone: Axes = {key: (written,) for key, written in chosen.items()}
    (draft,) = _drafts(replace(config, search={}, grid=alone))
    return None if draft.faults else draft.labelled()


def case_count(config: Config) -> int:
    """Number of combinations, including excluded and equal ones."""
    lengths = [len(values) for values in config.grid.values()]
    return prod(lengths + [len(next(iter(tied.values()))) for tied in config.zip])


def expand(config: Config) -> list[Case]:
    """All cases; the first axis of the grid varies slowest, and of equal cases the first is kept.

    A key that no case uses is refused, since it has no effect. So is a table of [[exclude]] that
    drops no case. Of several combinations, those that do not print are left out if
    `lattice.printable` asks for it, but not all of them.
    """
    return list(config.cases)


def _cases(config: Config) -> tuple[Iterable[Case], int]:
    """The cases, and the number of combinations that are left out as they do not print."""
    count = case_count(config)
    if count > MAX_CASES:
        line = f"[grid] makes {count:,} cases; allowed: at most {MAX_CASES:,} in one sweep"
        raise ConfigError([Fault("grid", line)])
    cases: dict[str, Case] = {}
    refused: dict[str, list[tuple[Fault, Values]]] = {}
    unused = dict.fromkeys(_keys_to_use(config), "")
    dropped: set[int] = set()
    unprintable: list[tuple[Fault, Values]] = []
    for draft in _drafts(config):
        matching = {k for k, table in enumerate(config.exclude) if draft.matches(table)}
        dropped |= matching
        if matching:
            continue
        if count > 1 and [fault.key for fault in draft.faults] == [PRINTABLE]:
            unprintable += [(fault, draft.chosen) for fault in draft.faults]
            continue
        for fault in draft.faults:
            refused.setdefault(fault.key, []).append((fault, draft.chosen))
        if not draft.faults:
            cases.setdefault(draft.case.case_id, draft.labelled())
            unused = still_unused(unused, draft.given, draft.case) if unused else unused
    if refused and not (config.search and cases):
        count = max(count, *map(len, refused.values()))
        raise ConfigError([_merged(found, count, config) for found in refused.values()])
    if unprintable and not cases:
        raise ConfigError([_merged(unprintable, count, config)])
    if not cases:
        line = f"[[exclude]] drops all {count:,} cases; allowed: tables that leave at least one"
        raise ConfigError([Fault("exclude", line)])
    faults = [_dropping_none(config, k) for k in range(len(config.exclude)) if k not in dropped]
    if any(unused.values()):
        faults += _without_effect(config, unused)
    if faults:
        raise ConfigError(faults)
    return cases.values(), len(unprintable)


@dataclass(frozen=True)
class _Combination:
    """One combination: its values along the axes, all given values, its draft and its faults."""

    chosen: Values
    given: dict[str, Any]
    draft: Draft
    faults: list[Fault]

    @property
    def case(self) -> Case:
        """The case of a combination without faults."""
        return self.draft.sound()

    def value(self, key: str) -> Any:
        """The value of the case; of an alias, the value that all its targets share."""
        first, *others = [self._value(target) for target in _keys(key)]
        return first if all(other == first for other in others) else None

    def _value(self, target: str) -> Any:
        """The value of a key; where its table is refused, the given one or the default."""
        table, name = target.split(".")
        if table in self.draft.tables:
            return getattr(self.draft.tables[table], name, None)
        kinds = [kind.model_fields[name] for kind in KINDS[table] if name in kind.model_fields]
        return self.given.get(target, kinds[0].get_default() if kinds else None)

    def matches(self, table: dict[str, tuple[object, ...]]) -> bool:
        """True if the case has, for every key of an [[exclude]] table, one of its values."""
        return all(rounded(self.value(key)) in values for key, values in table.items())

    def labelled(self) -> Case:
        """The case with its values along the axes."""
        values = {key: self.value(key) for key in self.chosen}
        axes = {key: int(v) if isinstance(v, bool) else v for key, v in values.items()}
        return self.case.model_copy(update={"axes": axes})


def _drafts(config: Config) -> Iterator[_Combination]:
    make = cached()
    for chosen in _combinations(config):
        written = config.base | _targets(chosen)
        given = {key: value for key, (value, *_) in written.items()}
        tables: dict[str, dict[str, Any]] = {name: {} for name in TABLES}
        for key, value in given.items():
            table, name = key.split(".")
            tables[table][name] = value
        try:
            draft = complete(tables, make)
        except RecordError as error:
            raise ConfigError([Fault("material.name", f"material.name: {error}")]) from None
        in_order = sorted(draft.refused, key=lambda refused: TABLES.index(refused.table))
        faults = [_fault(refused, written) for refused in in_order]
        yield _Combination(chosen, given, draft, faults)


def _keys_to_use(config: Config) -> list[str]:
    """The keys of a case that a config sets, of which every one must have an effect."""
    stated = [key for key in config.base if key not in MAY_BE_UNUSED]
    return stated + [target for _, name, _ in _axes(config) for target in _keys(name)]


def _without_effect(config: Config, unused: dict[str, str]) -> list[Fault]:
    """A fault for each key that no case uses; `unused` holds the reasons."""
    lines = {key: f"{written.name or key} = {written.text}" for key, written in config.base.items()}
    for where, name, values in _axes(config):
        texts = ", ".join(written.text for written in values)
        lines[_keys(name)[0]] = f"{where} {name} = [{texts if len(texts) < 60 else '...'}]"
    return [Fault(key, f"{line}: {unused[key]}") for key, line in lines.items() if unused.get(key)]


def _dropping_none(config: Config, number: int) -> Fault:
    """The fault of an [[exclude]] table that matches no combination."""
    where = f"[[exclude]] of {', '.join(config.exclude[number])}, number {number + 1}"
    return Fault("exclude", f"{where}: drops no case; allowed: tables that drop at least one")


def _axes(config: Config) -> Iterator[tuple[str, str, tuple[Written, ...]]]:
    """Every axis: the table that has it, its key, its values."""
    for where, axes in [("[grid]", config.grid), *(("[[zip]]", tied) for tied in config.zip)]:
        yield from ((where, name, values) for name, values in axes.items())
    yield from (("[search]", name, axis.probes) for name, axis in config.search.items())


def _combinations(config: Config) -> Iterator[Values]:
    """Values along the axes: every value of the grid with every row of each zip.

    Of a search, one axis at a time takes its values, while the others keep their middle.
    """
    if config.search:
        middle = {key: axis.probes[0] for key, axis in config.search.items()}
        for key, axis in config.search.items():
            yield from (middle | {key: written} for written in axis.probes)
        return
    parts = [[{key: value} for value in values] for key, values in config.grid.items()]
    for tied in config.zip:
        rows = zip(*tied.values(), strict=True)
        parts.append([dict(zip(tied, row, strict=True)) for row in rows])
    for choice in product(*parts):
        yield {key: written for part in choice for key, written in part.items()}


def _targets(chosen: Values) -> Values:
    """The chosen values by keys of a case: aliases are replaced, defaults left out."""
    set_here = {key: written for key, written in chosen.items() if written.value is not None}
    return {target: written for key, written in set_here.items() for target in _keys(key)}


def _keys(name: str) -> tuple[str, ...]:
    """The keys of a case that a key of a config sets."""
    return ALIASES.get(name, (name,))


def _fault(refused: RefusedError, given: Values) -> Fault:
    """The fault of one case, in the words of the file if the file sets the key."""
    key, value, allowed = refused.key, refused.value, refused.allowed
    if key in given:
        written, allowed = given[key], _in_unit_of(given[key], key, allowed)
        line = f"{written.name or key} = {written.text}: does not fit; allowed: {allowed}"
        return Fault(key, line)
    if value is None:
        return Fault(key, f"{key} is missing; needed: {allowed}")
    text = f"{value:g}" if isinstance(value, float) else json.dumps(value)
    unit = case_keys()[key].unit
    text = text if unit in (None, "1") else f"{text} {unit}"
    of_a_file = "material.name" in given and key in OF_A_FILE
    why = f" in the file of {given['material.name'].text}" if of_a_file else " by default"
    why = f", as {refused.since} is given" if refused.since else why
    return Fault(key, f"{key} = {text}{why}: does not fit; allowed: {allowed}")


def _in_unit_of(written: Written, key: str, sentence: str) -> str:
    """A sentence with its SI quantities converted to the unit that the file uses for a key."""
    unit, match = case_keys()[key].unit, _QUANTITY.fullmatch(written.text)
    if unit is None or match is None:
        return sentence
    scale = float(match[1]) / written.value
    in_si = re.compile(rf"([\d.e+-]+) {re.escape(unit)}(?![\w/^])")
    return in_si.sub(lambda found: f"{float(found[1]) * scale:.4g} {match[2]}", sentence)


def _merged(found: list[tuple[Fault, Values]], count: int, config: Config) -> Fault:
    """One fault for all cases that share it, with the line of the first and what only they have."""
    (key, line), _ = found[0]
    if count > 1:
        shared = _shared(key, [chosen for _, chosen in found], config)
        line += f" ({len(found):,} of {count:,} combinations{shared})"
    return Fault(key, line)


def _shared(key: str, chosen: list[Values], config: Config) -> str:
    """The values along the axes, but for those of a key, that all of these combinations have, and
    not all others.
    """
    words = [
        f"{name} = {values[0].text}"
        for _, name, axis in _axes(config)
        if name != key and len({written.text for written in axis}) > 1
        for values in [[combination[name] for combination in chosen]]
        if len({written.text for written in values}) == 1
    ]
    all_with = "all with" if len(chosen) > 1 else "with"
    return f", {all_with} {', '.join(words)}" if words else ""
