"""Reads a TOML document, table by table, into a sweep; every fault becomes one line."""

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from sweep.config import drop_tests
from sweep.config.axis import Choice, Interval, Written
from sweep.config.faults import Fault, MisfitError, in_words, one_line
from sweep.config.grid import Axes, Config, Recipe, Values
from sweep.config.keys import ALIASES, Key, case_keys, table_keys
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.drawn import Drawn
from sweep.config.kinds.table import TABLES, rounded, similar
from sweep.config.materials.material_file import (
    RecordError,
    UnknownMaterialError,
    available,
    locate,
    read_record,
)
from sweep.config.materials.plausibility import suspicion
from sweep.config.profiles.profile import read_profile
from sweep.config.profiles.settings import NEEDED
from sweep.config.question import QUESTION, Rank, Require
from sweep.config.reading.other_names import CHOICES, meant, present_choice, with_words
from sweep.config.structures.structure_file import StructureError
from sweep.config.units import in_si

_REASONS = {
    "literal_error": "unknown choice",
    "finite_number": "not finite",
    "missing": "too few values",
    "too_long": "too many values",
}
FILED = (CustomStructure, Drawn)  # lattices of a `lattice.file`
PROFILE = "lattice.profile"
OF_A_PATTERN = ("slicer", "pattern", "infill", "fill_angle", "fill_multiline")
SEARCHED = 100  # faults after which no nearest key is searched, which is slow
NAMELESS = "unnamed"  # the name of a config that has neither a name nor a file
BRANCH = ("time", "share")  # keys of a branch of relaxation
BY_MATERIAL = {
    "loading.strain_rate",
    "lattice.mass",
    "solver.bend_measure",
    "solver.joints",
}
"""Keys of other tables that may be refused because of the material."""
RANGE = ("from", "to")  # keys of a range of a search
IN_SEARCH = "a range, which belongs into [search]"
NAME = re.compile(r"\w[\w.-]*")
NO_NAME = "not a name; allowed: letters, digits, dots, dashes, underscores"


class Reader:
    """Turns a document into a config and collects its faults.

    folder: the folder of the document, to which paths in it are relative.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.faults: list[Fault] = []
        self.varied: dict[str, str] = {}  # keys of a case that vary, and the table that says so
        self.notes: list[str] = []
        self.of_file: type[CustomStructure | Drawn] | None = FILED[0]  # reads `lattice.file`

    def config(self, document: dict[str, Any], path: Path | None) -> Config:
        """The config of a whole document, without its cases; path: of its file, if it has one."""
        sections = ["name", *TABLES, "grid", "zip", "exclude", "search", *QUESTION]
        for section in document:
            if section not in sections:
                self._unknown(section, document[section], sections)
        usual = path.stem if path else NAMELESS
        return Config(
            name=self._name(document["name"]) if "name" in document else usual,
            recipe=self._recipe(document),
            rank=self._rank(self._question(document, "rank")),
            require=Require(**self._question(document, "require")),
            path=path,
        )

    def _recipe(self, document: dict[str, Any]) -> Recipe:
        """The values in a document, and values of profiles that it does not give itself."""
        document, one = _without(document, "lattice", "profile")
        document, several = _without(document, "grid", PROFILE)
        keys = _mentioned(document)
        words = keys.get("lattice.kind", ())
        named = [kind for kind in FILED if any(word in words for word in kind.words)]
        self.of_file = next(iter(named), None if words else FILED[0])
        stated = {target for name in keys for target in (name, *ALIASES.get(name, ()))}
        base = self._base(document)
        grid = self._axes(_flat(self._section(document, "grid")), "[grid]")
        ties = [*map(self._zip, self._tables(document, "zip"))]
        search = self._search(document)
        self.notes += [
            f"{key}: {where} replaces the value in [{_table(key)}]"
            for key, where in self.varied.items()
            if key in base and not any(_has_blank(tied, key) for tied in ties)
        ]
        if one is not None:
            base |= self._profile(one, stated)
        tied = {} if several is None else self._profiles(several, stated, one is not None)
        return Recipe(
            base=base,
            grid=grid,
            zip=tuple(filter(None, [*ties, tied])),
            exclude=tuple(filter(None, map(self._exclude, self._tables(document, "exclude")))),
            search=search,
        )

    def trusts(self, fault: Fault) -> bool:
        """False if this fault of a case may be a consequence of an earlier fault."""
        depends_on = {
            "lattice": {"lattice"},
            "material": {"material"},
            "grid": set(),
            "exclude": {*TABLES, "exclude", "grid", "zip"},
        }.get(_table(fault.key), set(TABLES) - {"material"})
        depends_on = depends_on | ({"material"} if fault.key in BY_MATERIAL else set())
        return not depends_on & {_table(other.key) for other in self.faults if not other.understood}

    def _name(self, name: object) -> str:
        if isinstance(name, str) and NAME.fullmatch(name):
            return name
        self._refuse("name", name, NO_NAME)
        return ""

    def _section(self, document: dict[str, Any], name: str) -> dict[str, Any]:
        section = document.get(name, {})
        if isinstance(section, dict):
            return section
        self._refuse(name, section, f"not a table; allowed: a table [{name}]")
        return {}

    def _tables(self, document: dict[str, Any], name: str) -> list[dict[str, Any]]:
        tables = document.get(name, [])
        if isinstance(tables, list) and all(isinstance(table, dict) for table in tables):
            return [_flat(table) for table in tables]
        self._refuse(name, tables, f"not a list of tables; allowed: tables [[{name}]]")
        return []

    def _base(self, document: dict[str, Any]) -> Values:
        """The values that all cases share, unless an axis replaces them."""
        base: Values = {}
        names: dict[str, str] = {}  # key of a case -> the name under which the config sets it
        for table in TABLES:
            for field, raw in self._branches(self._section(document, table), table).items():
                name = f"{table}.{field}"
                if (written := self._value(name, raw)) is None:
                    continue
                for target in ALIASES.get(name, (name,)):
                    first = base.setdefault(target, written)
                    other = names.setdefault(target, name)
                    if first.value != written.value:
                        wrong = f"set twice; allowed: the same as {other} = {first.text}"
                        self._refuse(name, raw, wrong)
        return base

    def _profile(self, raw: Any, stated: set[str]) -> Values:
        """The values of a slicer's profile for keys that the document does not give."""
        if not isinstance(raw, str):
            self._refuse(PROFILE, raw, f"no path; needed: {NEEDED}")
            return {}
        try:
            profile = read_profile(self.folder / raw, raw)
        except MisfitError as error:
            self._refuse(PROFILE, raw, str(error))
            return {}
        self.notes += profile.notes
        replaced = [key for key in profile.values if _is_stated(key, stated)]
        if replaced:
            self.notes.append(f"{raw}: the config says otherwise: {', '.join(replaced)}")
        read, before = {}, len(self.faults)
        for key, value in profile.values.items():
            written = None if key in replaced else self._value(f"lattice.{key}", value)
            if written:
                text = f"{written.text} (of {raw})"
                read[f"lattice.{key}"] = written._replace(text=text, implied=True)
        self.faults[before:] = [f._replace(line=f"{f.line} ({raw})") for f in self.faults[before:]]
        return read

    def _profiles(self, raws: Any, stated: set[str], beside: bool) -> Axes:
        """Profiles as values of a grid: keys that vary together."""
        if beside:
            self._refuse(PROFILE, raws, "in [lattice] too; allowed: one of them", "[grid]")
            return {}
        if not isinstance(raws, list) or not raws:
            self._refuse(PROFILE, raws, "no list of profiles; allowed: paths", "[grid]")
            return {}
        read = [self._profile(raw, stated) for raw in raws]
        names = dict.fromkeys(name for values in read for name in values)
        self.varied |= dict.fromkeys(names, f"[grid] {PROFILE}")
        none = Written(None, '""', implied=True)
        return {name: tuple(values.get(name, none) for values in read) for name in names}

    def _branches(self, section: dict[str, Any], table: str) -> dict[str, Any]:
        """A table whose branches of relaxation, if it has any, are lists of times and of shares."""
        if table != "material" or "relaxation" not in section:
            return section
        left = {name: value for name, value in section.items() if name != "relaxation"}
        branches = section["relaxation"]
        if not isinstance(branches, list) or not all(map(_is_branch, branches)) or not branches:
            allowed = 'a list of tables, each {time = "1 ms", share = 0.05}'
            self._refuse("material.relaxation", branches, f"no branches; allowed: {allowed}")
            return left
        lists = {f"relaxation_{name}s": [b[name] for b in branches] for name in BRANCH}
        if twice := [name for name in lists if name in left]:
            wrong = f"material.{twice[0]} states the same; allowed: one of them"
            self._refuse("material.relaxation", branches, wrong)
        return left | lists

    def _question(self, document: dict[str, Any], table: str) -> dict[str, Any]:
        """The values of a table that poses a question about the results."""
        section = self._section(document, table)
        read = {field: self._value(f"{table}.{field}", raw) for field, raw in section.items()}
        return {field: written.value for field, written in read.items() if written}

    def _rank(self, values: dict[str, Any]) -> Rank:
        if values.get("per") == "panel" and "panel" not in values:
            self._refuse("rank.per", "panel", 'no rank.panel; allowed: "specimen", or a panel')
        return Rank(**values)

    def _axes(self, axes: dict[str, Any], where: str) -> Axes:
        """Keys that vary, each with its values."""
        return {
            name: values for name, raw in axes.items() if (values := self._axis(name, raw, where))
        }

    def _axis(self, name: str, raw: Any, where: str) -> tuple[Written, ...]:
        key = case_keys().get(name)
        if name == PROFILE:
            self._refuse(name, raw, "a profile; allowed: in [lattice] or [grid]", where)
        elif key is None:
            self._unknown(name, raw, case_keys(), where)
        elif key.is_list:
            self._refuse(name, raw, "a list itself, no axis; allowed: keys with one value", where)
        elif not isinstance(raw, list) or not raw:
            wrong = "no values" if raw == [] else "not a list"
            wrong = IN_SEARCH if is_range(raw) else wrong
            self._refuse(name, raw, f"{wrong}; allowed: a list, each {key.allowed}", where)
        elif other := next((self.varied[t] for t in key.targets if t in self.varied), None):
            self._refuse(name, raw, f"varied in {other} too; allowed: one of them", where)
        else:
            self.varied |= dict.fromkeys(key.targets, where)
            values = [self._value(name, value, where) for value in raw]
            return tuple(value for value in values if value)
        return ()

    def _zip(self, table: dict[str, Any]) -> Axes:
        """Keys that vary together; an empty text leaves a key unset in that row."""
        tied = self._axes(table, "[[zip]]")
        lengths = {name: len(raw) for name, raw in table.items() if isinstance(raw, list)}
        if len(set(lengths.values())) > 1:
            name = max(lengths, key=lengths.__getitem__)
            counts = ", ".join(f"{name} has {length}" for name, length in lengths.items())
            wrong = f"lengths differ ({counts}); allowed: lists of equal length"
            self._refuse(name, table[name], wrong, "[[zip]]")
        return tied if len({len(values) for values in tied.values()}) == 1 else {}

    def _search(self, document: dict[str, Any]) -> dict[str, Interval | Choice]:
        """The values that a search may choose: keys with an interval, or with a list of values."""
        section = _flat(self._section(document, "search"))
        for other in ("grid", "zip", "exclude") if section else ():
            if document.get(other):
                wrong = f"beside [search]; allowed: one of [search] and [{other}]"
                self._refuse(other, document[other], wrong)
        read = {name: self._searched(name, raw) for name, raw in section.items()}
        return {name: axis for name, axis in read.items() if axis}

    def _searched(self, name: str, raw: Any) -> Interval | Choice | None:
        """The values of a key that a search may choose."""
        ranged = is_range(raw)
        values = self._axis(name, [raw[end] for end in RANGE] if ranged else raw, "[search]")
        if not ranged:
            return Choice(values) if values else None
        if len(values) < len(RANGE):
            return None
        low, high = (written.value for written in values)
        if isinstance(low, bool | str) or not low < high:
            wrong = "no range; allowed: numbers, from the smaller to the greater, or a list"
            self._refuse(name, raw, wrong, "[search]")
            return None
        unit = case_keys()[name].unit
        return Interval(name, low, high, "" if unit in (None, "1") else str(unit))

    def _exclude(self, table: dict[str, Any]) -> dict[str, tuple[object, ...]]:
        """The values of an [[exclude]] table, in the form of a case; empty if one is wrong."""
        if not table:
            self._refuse("[[exclude]]", table, "is empty; allowed: at least one key")
        excluded = {}
        for name, raw in table.items():
            raws = raw if isinstance(raw, list) else [raw]
            values = [self._value(name, value, "[[exclude]]") for value in raws]
            if raws == []:
                self._refuse(name, raw, "is empty; allowed: at least one value", "[[exclude]]")
            contents = [value.value for value in values if value]
            if name == "material.name":
                contents = [Path(value).name.removesuffix(".csv") for value in contents]
            if name == "lattice.file":
                contents = [Path(value).name for value in contents]
            if contents and len(contents) == len(raws):
                excluded[name] = tuple(rounded(value) for value in contents)
        return excluded if len(excluded) == len(table) else {}

    def _value(self, name: str, raw: Any, where: str = "") -> Written | None:
        """A value in SI; if it is wrong, one fault is added, and None unless it is understood."""
        questions = {} if where else table_keys("rank") | table_keys("require")
        keys = case_keys() | questions
        if name not in keys:
            self._unknown(name, raw, keys, where)
            return None
        if raw == "" and where == "[[zip]]":
            return Written(None, '""')
        try:
            if isinstance(raw, list) and not keys[name].is_list:
                raise MisfitError(f"a list{' in a list' if where else ', which belongs in [grid]'}")
            return Written(self._checked(keys[name], raw), in_words(raw), name)
        except RecordError as error:
            self._refuse(name, raw, str(error).removeprefix(f"{Path(raw).name}: "), where)
            return None
        except StructureError as error:
            for line in error.lines:
                self._refuse(name, raw, line, where)
            return None
        except MisfitError as error:
            key = keys[name]
            allowed = with_words(key.targets[0], key.allowed_for(raw))
            words = [*CHOICES.get(key.targets[0], ()), *key.schema.get("enum", ())]
            near = similar(raw, words) if isinstance(raw, str) else _in_percent(keys[name], raw)
            self._refuse(name, raw, f"{error}; allowed: {allowed}{near}", where)
            if not _is_share(key, raw):
                return None
            self.faults[-1] = self.faults[-1]._replace(understood=True)
            return Written(raw, in_words(raw), name)

    def _unknown(self, name: str, raw: Any, keys: Iterable[str], where: str = "") -> None:
        """Refuse an unknown key, and name the nearest."""
        names = [*keys]
        if name.startswith("lattice.") and "lattice.kind" in names and not where:
            names.append(PROFILE)
        near, wrong = "", "unknown key"
        if len(self.faults) < SEARCHED:
            near, clause = meant(name, names)
            wrong += f"; {clause}"
        self._refuse(name, raw, wrong, where, about=near)

    def _refuse(self, name: str, raw: Any, wrong: str, where: str = "", about: str = "") -> None:
        line = f"{where} {one_line(name)} = {in_words(raw)}: {wrong}".lstrip()
        self.faults.append(Fault(about or name, line))

    def _checked(self, key: Key, raw: Any) -> Any:
        """A value in SI; raises `MisfitError` with the reason if it is wrong."""
        if key.targets == ("material.name",) and isinstance(raw, str):
            return _material(raw, self.folder)
        if key.targets == ("lattice.file",) and isinstance(raw, str):
            return self._structure_path(raw)
        raw = present_choice(key.targets[0], raw)
        if key.targets == ("loading.preset",) and isinstance(raw, str):
            return drop_tests.in_si(raw)
        many = isinstance(raw, list)
        value: Any = [_in_si(key, v) for v in raw] if many else _in_si(key, raw)
        try:
            checked = key.adapter.validate_python(tuple(value) if many else value)
        except ValidationError as error:
            kind = error.errors()[0]["type"]
            wrong_type = "wrong type" if kind.endswith("_type") else "out of range"
            raise MisfitError(_REASONS.get(kind, wrong_type)) from None
        table, _, name = key.targets[0].partition(".")
        if table == "material" and (why := suspicion(name, checked)):
            raise MisfitError(f"no printed material has this; {why}")
        return checked

    def _structure_path(self, raw: str) -> str:
        """The absolute path of a user's own structure or drawing."""
        if self.of_file is None:
            words = (f'"{word}"' for kind in FILED for word in kind.words)
            why = f"has no effect with this lattice.kind; needed: {' or '.join(words)}"
            raise StructureError([why])
        path = self.folder / raw
        self.notes += [f"{raw}: {note}" for note in self.of_file.check_file(path)]
        return str(path.resolve())


def _in_si(key: Key, raw: Any) -> Any:
    """One value without its unit, if its key has one."""
    if is_range(raw):
        raise MisfitError(IN_SEARCH)
    bare = key.bare and isinstance(raw, int | float)
    if bare and raw > key.bare_most:
        raise MisfitError(f"a bare number above {key.bare_most:g}, which may be meant in percent")
    if key.bare and isinstance(raw, str) and _is_number(raw):
        raise MisfitError("a number in quotes, without a unit")
    return in_si(raw, key.unit) if key.unit and not bare else raw


def _is_number(text: str) -> bool:
    """Whether a text is a number without a unit."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def _in_percent(key: Key, raw: object) -> str:
    """A clause with a number that may be meant in percent, with its sign; else empty."""
    meant = key.unit == "1" and isinstance(raw, int | float) and 1 < raw < 100
    return f'; for {raw:g} percent: "{raw:g} %"' if meant else ""


def _is_share(key: Key, raw: object) -> bool:
    """Whether a number without a unit can only be a share."""
    return key.unit == "1" and not key.bare and isinstance(raw, float) and 0.0 < raw < 1.0


def is_range(value: object) -> bool:
    """Whether a value is a range of a search: a table with its ends."""
    return isinstance(value, dict) and sorted(value) == sorted(RANGE)


def _without(document: dict[str, Any], section: str, key: str) -> tuple[dict[str, Any], Any]:
    """A document without a key of a section, and the value of the key; None if there is none."""
    table = document.get(section)
    flat = _flat(table) if isinstance(table, dict) else {}
    if key not in flat:
        return document, None
    value = flat.pop(key)
    return document | {section: flat}, value


def _mentioned(document: dict[str, Any]) -> dict[str, list[Any]]:
    """The keys of [lattice], and keys that vary, with all values of a document; dotted."""
    ties = document.get("zip")
    tables = [{"lattice": document.get("lattice")}, document.get("grid"), document.get("search")]
    keys: dict[str, list[Any]] = {}
    for table in [*tables, *(ties if isinstance(ties, list) else [])]:
        for name, value in _flat(table).items() if isinstance(table, dict) else ():
            keys.setdefault(name, []).extend(value if isinstance(value, list) else [value])
    return keys


def _has_blank(tied: Axes, key: str) -> bool:
    """Whether a row of a zip leaves a key of a case unset."""
    return any(
        written.value is None
        for name, values in tied.items()
        if key in ALIASES.get(name, (name,))
        for written in values
    )


def _is_stated(key: str, stated: set[str]) -> bool:
    """Whether a document gives a key of a profile, or another that replaces it: a distance of lines
    replaces the share of infill, and drawn cells replace the pattern.
    """
    others = ("mass", "line_distance") if key == "infill" else ()
    drawn = key in OF_A_PATTERN and "lattice.kind" in stated
    return drawn or any(f"lattice.{name}" in stated for name in (key, *others))


def _is_branch(value: object) -> bool:
    """Whether a value is a branch of relaxation: a table with a time and a share."""
    return isinstance(value, dict) and sorted(value) == sorted(BRANCH)


def _material(name: str, folder: Path) -> str:
    """The name of a shipped material, or the absolute path of a user's own record."""
    try:
        path = locate(name, folder)
    except UnknownMaterialError:
        is_file, file = name.endswith(".csv"), folder / name
        unknown = f"unknown material{similar(name, available())}"
        raise MisfitError(f"there is no {file}" if is_file else unknown) from None
    read_record(path)
    return str(path.resolve()) if name.endswith(".csv") else name


def _flat(table: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Dotted keys of nested tables: "lattice.cells" = 3 and lattice.cells = 3 are the same."""
    flat: dict[str, Any] = {}
    for name, value in table.items():
        is_table = isinstance(value, dict) and not is_range(value)
        inner = _flat(value, f"{prefix}{name}.") if is_table else None
        flat |= inner or {f"{prefix}{name}": value}
    return flat


def _table(key: str) -> str:
    return key.split(".")[0]
