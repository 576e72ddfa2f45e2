"""From a config to its cases: grid x zips, without excluded cases and duplicates."""

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import product
from math import prod
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from sweep.config.case import TABLES, Case
from sweep.config.keys import ALIASES, case_keys
from sweep.config.resolve import resolve
from sweep.config.tables import Rank, Require, Table, rounded
from sweep.config.unused_keys import still_unused

MAX_CASES = 1_000_000
SHOWN = 10  # faults that the text of a ConfigError lists
_QUANTITY = re.compile(r'"([\d.eE+-]+)\s*(.+)"')
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


class Written(NamedTuple):
    """A value in SI (None: not set), its text in the file, and its key in the file."""

    value: Any
    text: str
    name: str = ""


Reason = dict[str, Any]  # key, value, allowed
Values = dict[str, Written]
Axes = dict[str, tuple[Written, ...]]


@dataclass(frozen=True)
class Config:
    """A sweep: the values that all cases share, and the axes that vary; keys are dotted.

    grid, zip: key -> values; every value of the grid meets every row of every zip.
    exclude: tables key -> rounded values. A case is dropped if, for every key of a table, its value
    is among the values of that key.
    """

    name: str
    base: Values = field(default_factory=dict)
    grid: Axes = field(default_factory=dict)
    zip: tuple[Axes, ...] = ()
    exclude: tuple[dict[str, tuple[object, ...]], ...] = ()
    rank: Rank = field(default_factory=Rank)
    require: Require = field(default_factory=Require)
    path: Path | None = None

    @cached_property
    def cases(self) -> tuple[Case, ...]:
        """The cases that `expand` returns, computed once."""
        return tuple(_cases(self))


def case_count(config: Config) -> int:
    """Number of combinations, including excluded and equal ones."""
    lengths = [len(values) for values in config.grid.values()]
    return prod(lengths + [len(next(iter(tied.values()))) for tied in config.zip])


def expand(config: Config) -> list[Case]:
    """All cases; the first axis of the grid varies slowest, and of equal cases the first is kept.

    A key that no case uses is refused, since it has no effect. So is a table of [[exclude]] that
    drops no case.
    """
    return list(config.cases)


def _cases(config: Config) -> Iterable[Case]:
    count = case_count(config)
    if count > MAX_CASES:
        line = f"[grid] makes {count:,} cases; allowed: at most {MAX_CASES:,} in one sweep"
        raise ConfigError([Fault("grid", line)])
    cases: dict[str, Case] = {}
    refused: dict[str, list[Fault]] = {}
    unused = dict.fromkeys(_keys_to_use(config), "")
    dropped: set[int] = set()
    for draft in _drafts(config):
        matching = {k for k, table in enumerate(config.exclude) if draft.matches(table)}
        dropped |= matching
        if matching:
            continue
        for fault in draft.faults:
            refused.setdefault(fault.key, []).append(fault)
        if not draft.faults:
            cases.setdefault(draft.case.case_id, draft.labelled())
            unused = still_unused(unused, draft.given, draft.case) if unused else unused
    if refused:
        raise ConfigError([_merged(faults, count) for faults in refused.values()])
    if not cases:
        line = f"[[exclude]] drops all {count:,} cases; allowed: tables that leave at least one"
        raise ConfigError([Fault("exclude", line)])
    faults = [_dropping_none(config, k) for k in range(len(config.exclude)) if k not in dropped]
    if any(unused.values()):
        faults += _without_effect(config, unused)
    if faults:
        raise ConfigError(faults)
    return cases.values()


@dataclass(frozen=True)
class _Draft:
    """One combination: its values along the axes, all given values, its case and its faults."""

    chosen: Values
    given: dict[str, Any]
    case: Case
    faults: list[Fault]

    def value(self, key: str) -> Any:
        """The value of the resolved case; of an alias, the value that all its targets share."""
        targets = [target.split(".") for target in _keys(key)]
        first, *others = [getattr(getattr(self.case, table), name) for table, name in targets]
        return first if all(other == first for other in others) else None

    def matches(self, table: dict[str, tuple[object, ...]]) -> bool:
        """True if the case has, for every key of an [[exclude]] table, one of its values."""
        return all(rounded(self.value(key)) in values for key, values in table.items())

    def labelled(self) -> Case:
        """The case with its values along the axes."""
        values = {key: self.value(key) for key in self.chosen}
        axes = {key: int(v) if isinstance(v, bool) else v for key, v in values.items()}
        return self.case.model_copy(update={"axes": axes})


def _drafts(config: Config) -> Iterator[_Draft]:
    made = cache(_table)  # most cases share most of their tables
    for chosen in _combinations(config):
        written = config.base | _targets(chosen)
        given = {key: value for key, (value, *_) in written.items()}
        values = [(*key.split("."), value) for key, value in given.items()]
        tables: dict[str, Table] = {}
        wrong: list[Reason] = []
        for name in TABLES:
            items = tuple((field, value) for table, field, value in values if table == name)
            tables[name], reasons = made(name, items)
            wrong += reasons
        sound = not any(reason["key"].startswith("lattice.") for reason in wrong)
        resolved, refused = resolve(tables, sound)
        wrong += [refused.context or {}] if refused else []
        case = Case.model_construct(None, **resolved)
        yield _Draft(chosen, given, case, [_fault(reason, written) for reason in wrong])


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


def _combinations(config: Config) -> Iterator[Values]:
    """Values along the axes: every value of the grid with every row of each zip."""
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


def _table(name: str, items: tuple[tuple[str, Any], ...]) -> tuple[Table, list[Reason]]:
    """A table of these values, and the reasons why it cannot be used."""
    try:
        return TABLES[name].model_validate(dict(items)), []
    except ValidationError as error:
        table = TABLES[name].model_construct(None, **dict(items))
        return table, [_reason(name, wrong) for wrong in error.errors()]


def _reason(table: str, wrong: ErrorDetails) -> Reason:
    """The reason of a refusal, or of a number of a record that is out of range.

    A record that cannot be read raises `ConfigError`.
    """
    if wrong["type"] == "refused":
        return wrong["ctx"]
    if wrong["type"] == "value_error":
        raise ConfigError([Fault("material.name", f"material.name: {wrong['ctx']['error']}")])
    key = f"{table}.{wrong['loc'][0]}"
    return {"key": key, "value": wrong["input"], "allowed": case_keys()[key].allowed}


def _fault(reason: Reason, given: Values) -> Fault:
    """The fault of one case, in the words of the file if the file sets the key."""
    key, value, allowed = reason["key"], reason["value"], reason["allowed"]
    if key in given:
        written, allowed = given[key], _in_unit_of(given[key], key, allowed)
        line = f"{written.name or key} = {written.text}: does not fit; allowed: {allowed}"
        return Fault(key, line)
    if value is None:
        return Fault(key, f"{key} is missing; needed: {allowed}")
    text = f"{value:g}" if isinstance(value, float) else json.dumps(value)
    unit = case_keys()[key].unit
    text = text if unit in (None, "1") else f"{text} {unit}"
    why = f", as {reason['since']} is given" if reason.get("since") else " by default"
    return Fault(key, f"{key} = {text}{why}: does not fit; allowed: {allowed}")


def _in_unit_of(written: Written, key: str, sentence: str) -> str:
    """A sentence with its SI quantities converted to the unit that the file uses for a key."""
    unit, match = case_keys()[key].unit, _QUANTITY.fullmatch(written.text)
    if unit is None or match is None:
        return sentence
    scale = float(match[1]) / written.value
    in_si = re.compile(rf"([\d.e+-]+) {re.escape(unit)}(?![\w/^])")
    return in_si.sub(lambda found: f"{float(found[1]) * scale:.4g} {match[2]}", sentence)


def _merged(faults: list[Fault], count: int) -> Fault:
    """One fault for all cases that share it, with the line of the first."""
    key, line = faults[0]
    if count > 1:
        line += f" ({len(faults):,} of {count:,} combinations)"
    return Fault(key, line)
