"""Expands a config into its cases: grid x zips, without excluded ones and duplicates."""

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from math import prod
from pathlib import Path
from typing import Any, NamedTuple

from sweep.config.axis import Choice, Interval, Written
from sweep.config.case import Case, Draft, complete
from sweep.config.cases import Cases
from sweep.config.faults import ConfigError, Fault, in_words
from sweep.config.keys import ALIASES, KINDS, case_keys
from sweep.config.kinds.table import TABLES, RefusedError, rounded
from sweep.config.materials.material_file import RecordError
from sweep.config.materials.material_header import UNITS
from sweep.config.question import Rank, Require
from sweep.config.reading.keys_without_effect import keys_without_effect
from sweep.numbers import counted, text_in

MAX_CASES = 1_000_000
_QUANTITY = re.compile(r'"([\d.eE+-]+)\s*(.+)"')
_LENGTH = re.compile(r"(?<![\w.])([\d.]+(?:e[+-]?\d+)?) m(?![\w/^])")  # in SI
_NUMBER = re.compile(r"[\d.]+(?:e[+-]?\d+)?")
PRINTABLE = "lattice.printable"
FAMILY = frozenset(("lattice.kind", "lattice.pattern"))
OF_A_FILE = frozenset(f"material.{name}" for name in UNITS)
SWEEP = "cases of crumple.case, or what crumple.load_config returns"
ONLY_OPTIMIZE = "only `crumple optimize` searches; allowed here: lists of values in [grid]"
MAY_BE_UNUSED = ("material.poisson",)  # a property of the material, stated even in plane stress


Values = dict[str, Written]
Axes = dict[str, tuple[Written, ...]]


@dataclass(frozen=True)
class Recipe:
    """The content of a config: the values that all cases share, and the axes; keys are dotted.

    grid, zip: key -> values; every value of the grid is combined with every row of every zip.
    exclude: tables key -> rounded values. A case is dropped if, for every key of a table, its value
    is among the values of that key. search: key -> values that a search may choose.
    """

    base: Values = field(default_factory=dict)
    grid: Axes = field(default_factory=dict)
    zip: tuple[Axes, ...] = ()
    exclude: tuple[dict[str, tuple[object, ...]], ...] = ()
    search: dict[str, Interval | Choice] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Number of combinations, including excluded and equal ones."""
        lengths = [len(values) for values in self.grid.values()]
        return prod(lengths + [len(next(iter(tied.values()))) for tied in self.zip])


class LeftOut(NamedTuple):
    """How many of all combinations of a grid are impossible, and a line for each reason."""

    impossible: int = 0
    of: int = 0
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True, repr=False)
class Config:
    """A sweep: its cases, and the question about their results.

    cases: for a config with a search, the cases that the search has chosen so far. left_out: the
    combinations without a case. seed: of a search. recipe: content of its file; nothing for cases
    without a file. notes: sentences about the slicer profiles that were read. part: "1/2" for the
    first of two parts of a sweep.
    """

    name: str
    cases: Sequence[Case] = ()
    rank: Rank = field(default_factory=Rank)
    require: Require = field(default_factory=Require)
    path: Path | None = None
    recipe: Recipe = field(default_factory=Recipe)
    left_out: LeftOut = field(default_factory=LeftOut)
    seed: int = 0
    notes: tuple[str, ...] = ()
    part: str = ""

    def __repr__(self) -> str:
        searched = f", a search of {', '.join(self.recipe.search)}" if self.recipe.search else ""
        return f"<Config {self.name}: {counted(len(self.cases), 'case')}{searched}>"


def expand(config: Config) -> list[Case]:
    """All cases of a config; the cases of a search are not known before it."""
    return list(cases_of(config))


def cases_of(config: Config) -> Sequence[Case]:
    """The same as `expand`, with each case made when it is requested."""
    if not isinstance(config, Config):
        raise _no_sweep(config, "what crumple.load_config returns")
    if config.recipe.search and not config.cases:
        line = f"[search] of {', '.join(config.recipe.search)}: {ONLY_OPTIMIZE}"
        raise ConfigError([Fault("search", line)])
    return config.cases


def sweep_of(cases: Config | Iterable[Case]) -> Config:
    """A config, or cases without one."""
    if isinstance(cases, Config):
        return cases
    if isinstance(cases, str | Mapping) or not isinstance(cases, Iterable):
        raise _no_sweep(cases, SWEEP)
    listed = tuple(cases)
    if other := [case for case in listed if not isinstance(case, Case)]:
        raise _no_sweep(other[0], SWEEP)
    return Config("", listed)


def _no_sweep(source: object, needed: str) -> ConfigError:
    return ConfigError([Fault("cases", f"{in_words(source)} is no sweep; needed: {needed}")])


def chosen_case(recipe: Recipe, chosen: Values) -> Case | None:
    """The case that a search chooses by these values, in SI; None if they cannot be combined."""
    alone: Axes = {key: (value,) for key, value in chosen.items()}
    (combination,) = _drafts(replace(recipe, search={}, grid=alone))
    return None if combination.faults else combination.labelled()


def expanded(recipe: Recipe) -> tuple[Sequence[Case], LeftOut]:
    """The cases, and which combinations are left out, as their values cannot be combined.

    The first axis of the grid varies slowest, and of equal cases the first is kept. Refused are a
    value that no combination can use (`_Combination.is_mistaken` has the exceptions), a grid
    without any possible case, a key that no case uses, and a table of [[exclude]] that drops no
    case. A search is tried at a few points (`_combinations`), and has no cases.
    """
    count = recipe.count
    if count > MAX_CASES:
        line = f"[grid] makes {count:,} cases; allowed: at most {MAX_CASES:,} in one sweep"
        raise ConfigError([Fault("grid", line)])
    cases = Cases()
    usable: set[tuple[str, str]] = set()
    impossible: list[_Combination] = []
    lines = _lines_to_use(recipe)
    unused = dict.fromkeys(lines, "")
    dropped: set[int] = set()
    for draft in _drafts(recipe):
        matching = {k for k, table in enumerate(recipe.exclude) if draft.matches(table)}
        dropped |= matching
        if matching:
            continue
        if draft.faults:
            impossible.append(draft)
            continue
        usable |= draft.texts
        case = draft.labelled()
        if case.case_id not in cases.ids:
            cases.add(case)
        unused = keys_without_effect(unused, draft.values, case) if unused else unused
    refused = [draft for draft in impossible if draft.is_mistaken(usable)] if cases else impossible
    if refused and not (recipe.search and cases):
        raise ConfigError(_reasons(refused, max(count, len(refused)), recipe))
    if not cases:
        every = f"all {count:,} cases" if count > 1 else "the only case"
        line = f"[[exclude]] drops {every}; allowed: tables that leave at least one"
        raise ConfigError([Fault("exclude", line)])
    faults = [_dropping_none(recipe, k) for k in range(len(recipe.exclude)) if k not in dropped]
    idle = {f"{lines[key]}: {why}": key for key, why in unused.items() if why}
    faults += [Fault(key, line) for line, key in idle.items()]
    if faults:
        raise ConfigError(faults)
    if recipe.search:
        return (), LeftOut()
    reasons = [fault.line for fault in _reasons(impossible, count, recipe)]
    return cases, LeftOut(len(impossible), count, tuple(reasons))


@dataclass(frozen=True)
class _Combination:
    """One combination: its values along the axes, all given values, its draft and its faults."""

    chosen: Values
    values: dict[str, Any]
    draft: Draft
    faults: list[Fault]

    @property
    def texts(self) -> set[tuple[str, str]]:
        """Its values along the axes, as the file writes them."""
        return {(key, written.text) for key, written in self.chosen.items()}

    def is_mistaken(self, usable: set[tuple[str, str]]) -> bool:
        """Whether it has a value that no combination can use, and is to be refused for that.

        It is merely left out if its walls do not print, or if its kind of lattice does not fit
        given values that other kinds can use.
        """
        unusable = {key for axis, text in self.texts - usable for key in _keys(axis)}
        if not unusable or [fault.key for fault in self.faults] == [PRINTABLE]:
            return False
        usable_keys = self.values.keys() - unusable
        return unusable.isdisjoint(FAMILY) or any(f.key not in usable_keys for f in self.faults)

    def value(self, key: str) -> Any:
        """The value of the case; for an alias, the value that all its targets share."""
        first, *others = [self._value(target) for target in _keys(key)]
        return first if all(other == first for other in others) else None

    def _value(self, target: str) -> Any:
        """The value of a key; if its table is refused, the given value or the default."""
        table, name = target.split(".")
        if part := self.draft.tables.get(table):
            words = getattr(part, "words", ()) if name == "mode" else ()
            return self.values[target] if self.values.get(target) in words else part.value(name)
        kinds = [kind.model_fields[name] for kind in KINDS[table] if name in kind.model_fields]
        return self.values.get(target, kinds[0].get_default() if kinds else None)

    def matches(self, table: dict[str, tuple[object, ...]]) -> bool:
        """True if the case has, for every key of an [[exclude]] table, one of its values."""
        return all(rounded(self.value(key)) in values for key, values in table.items())

    def labelled(self) -> Case:
        """The case of a combination without faults, with its values along the axes."""
        values = {key: self.value(key) for key in self.chosen}
        axes = {key: int(v) if isinstance(v, bool) else v for key, v in values.items()}
        return self.draft.sound(axes)


def _drafts(recipe: Recipe) -> Iterator[_Combination]:
    cache: dict[Any, Any] = {}
    for chosen in _combinations(recipe):
        written = recipe.base | _targets(chosen)
        values = {key: value.value for key, value in written.items()}
        tables: dict[str, dict[str, Any]] = {name: {} for name in TABLES}
        for key, value in values.items():
            table, name = key.split(".")
            tables[table][name] = value
        try:
            draft = complete(tables, cache)
        except RecordError as error:
            raise ConfigError([Fault("material.name", f"material.name: {error}")]) from None
        in_order = sorted(draft.refused, key=lambda refused: TABLES.index(refused.table))
        faults = [_fault(refused, written) for refused in in_order]
        yield _Combination(chosen, values, draft, faults)


def _lines_to_use(recipe: Recipe) -> dict[str, str]:
    """The keys of a case that a config sets, each of which must have an effect: key -> its line."""
    lines = {
        key: f"{written.name or key} = {written.text}"
        for key, written in recipe.base.items()
        if not (key in MAY_BE_UNUSED or written.implied)
    }
    for where, name, values in _axes(recipe):
        if not values[0].implied:
            texts = ", ".join(written.text for written in values)
            shown = texts if len(texts) < 60 else "..."
            lines[_keys(name)[0]] = f"{where} {name} = [{shown}]"
    return lines


def _dropping_none(recipe: Recipe, number: int) -> Fault:
    """The fault of an [[exclude]] table that matches no combination."""
    where = f"[[exclude]] of {', '.join(recipe.exclude[number])}, number {number + 1}"
    return Fault("exclude", f"{where}: drops no case; allowed: tables that drop at least one")


def _axes(recipe: Recipe) -> Iterator[tuple[str, str, tuple[Written, ...]]]:
    """Every axis: the table that has it, its key, its values."""
    for where, axes in [("[grid]", recipe.grid), *(("[[zip]]", tied) for tied in recipe.zip)]:
        yield from ((where, name, values) for name, values in axes.items())
    yield from (("[search]", name, axis.probes) for name, axis in recipe.search.items())


def _combinations(recipe: Recipe) -> Iterator[Values]:
    """Values along the axes: every value of the grid with every row of each zip.

    In a search, one axis at a time takes its values, while the others keep their middle.
    """
    if recipe.search:
        middle = {key: axis.probes[0] for key, axis in recipe.search.items()}
        for key, axis in recipe.search.items():
            yield from (middle | {key: written} for written in axis.probes)
        return
    parts = [[{key: value} for value in values] for key, values in recipe.grid.items()]
    for tied in recipe.zip:
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


def _fault(refused: RefusedError, written_values: Values) -> Fault:
    """The fault of one case, in the words of the file if the file sets the key."""
    key, value, allowed = refused.key, refused.value, refused.allowed
    if key in written_values:
        written, allowed = written_values[key], _in_unit_of(written_values[key], key, allowed)
        line = f"{written.name or key} = {written.text}: does not fit; allowed: {allowed}"
        return Fault(key, line)
    allowed = _in_mm(allowed)
    if value is None:
        return Fault(key, f"{key} is missing; needed: {allowed}")
    text = f"{value:g}" if isinstance(value, float) else json.dumps(value)
    unit = case_keys()[key].unit
    text = text if unit in (None, "1") else _in_mm(f"{text} {unit}")
    of_a_file = "material.name" in written_values and key in OF_A_FILE
    why = f" in the file of {written_values['material.name'].text}" if of_a_file else " by default"
    why = f", as {refused.since} is given" if refused.since else why
    return Fault(key, f"{key} = {text}{why}: does not fit; allowed: {allowed}")


def _in_mm(sentence: str) -> str:
    """A sentence with its lengths in mm instead of m."""
    return _LENGTH.sub(lambda length: text_in(float(length[1]), "mm", 6), sentence)


def _in_unit_of(written: Written, key: str, sentence: str) -> str:
    """A sentence with its SI quantities converted to the unit that the file uses for a key, and
    lengths in mm if the key is no length.
    """
    unit, match = case_keys()[key].unit, _QUANTITY.fullmatch(written.text)
    if unit is None or match is None or written.value == 0.0:
        return _in_mm(sentence)
    scale = float(match[1]) / written.value
    in_si = re.compile(rf"([\d.e+-]+) {re.escape(unit)}(?![\w/^])")
    text = in_si.sub(lambda quantity: f"{float(quantity[1]) * scale:.4g} {match[2]}", sentence)
    return text if unit == "m" else _in_mm(text)


def _reasons(refused: list[_Combination], count: int, recipe: Recipe) -> list[Fault]:
    """One fault for each refused value and each reason; reasons that differ in numbers alone are
    one. count: number of all combinations.
    """
    alike: dict[tuple[str, str], list[tuple[Fault, Values]]] = {}
    for draft in refused:
        for fault in draft.faults:
            value, _, reason = fault.line.partition(":")
            alike.setdefault(
                (fault.key, "") if recipe.search else (value, _NUMBER.sub("", reason)), []
            ).append((fault, draft.chosen))
    return [_merged(refusals, count, recipe) for refusals in alike.values()]


def _merged(refusals: list[tuple[Fault, Values]], count: int, recipe: Recipe) -> Fault:
    """The line of the first of several refusals, with their number and their common values."""
    (key, line, *_), _ = refusals[0]
    if count > 1:
        shared = _shared(key, [chosen for _, chosen in refusals], recipe)
        line += f" ({len(refusals):,} of {count:,} combinations{shared})"
    return Fault(key, line)


def _shared(key: str, chosen: list[Values], recipe: Recipe) -> str:
    """The values along the axes, except of one key, that all of these combinations have, and not
    all others.
    """
    words = [
        f"{name} = {values[0].text}"
        for _, name, axis in _axes(recipe)
        if name != key and len({written.text for written in axis}) > 1
        for values in [[combination[name] for combination in chosen]]
        if len({written.text for written in values}) == 1
    ]
    all_with = "all with" if len(chosen) > 1 else "with"
    return f", {all_with} {', '.join(words)}" if words else ""
