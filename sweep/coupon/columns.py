"""Identifies the columns of a machine's table: time, displacement, strain, force or stress, with
units.

The words of a head say which quantities it may be, its unit which of them. If several columns may
be the same quantity, the user is asked, unless their numbers are the same.
"""

import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from sweep.array_types import Floats
from sweep.config.faults import MisfitError
from sweep.coupon.table import Table
from sweep.coupon.unit import SI, size_in_si
from sweep.plain_text import plain

WORDS = {
    "time": "time zeit temps tiempo tempo t 时间 時間",
    "force": "force load kraft charge last carga fuerza forza f 力 试验力 試験力 負荷 载荷",
    "displacement": "displacement extension ext crosshead travel stroke position disp weg traverse "
    "course deplacement extensometer elongation allongement deformation deformacion deform "
    "verformung desplazamiento spostamento 位移 变形 変位 ストローク",
    "strain": "strain dehnung stauchung deformation deformacion deform elongation extension "
    "extensometer allongement 应变 ひずみ",
    "stress": "stress spannung contrainte tension 应力 応力",
}
"""Words in a head, without accents -> what it may be."""
ENDS = {
    "time": ("zeit",),
    "force": ("kraft",),
    "displacement": ("weg", "wegaufnehmer"),
    "stress": ("spannung",),
}
"""Ends of words in German."""
OTHERS = (
    "rate speed velocity true max maximum peak lateral transverse transversal width breite "
    "temperature command target setpoint work energy modulus break count cycles"
)
"""Words for other quantities that a machine records."""
CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")
"""Where a word ends in "LoadCell" and "XForce"."""
EQUAL = 0.01  # share of the range of a column within which two columns are the same
LONGEST = 40  # most characters of a head that are shown
CONSTANT = " (constant)"
MOST_HEADS = 8  # most heads that a message lists
EXAMPLES = {"time": "s", "displacement": "mm", "strain": "%", "force": "N", "stress": "MPa"}


@dataclass
class Columns:
    """The columns of a table by their quantity, in SI, and remarks on how they were identified.

    words: their heads, with units. notes: sentences on how they were read. questions: what could
    not be decided, with the option that decides it. undecided: quantities among these that already
    have a question.
    """

    values: dict[str, Floats] = field(default_factory=dict)
    words: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    questions: list[str] = field(default_factory=list)
    undecided: set[str] = field(default_factory=set)


def columns_of(table: Table, chosen: Mapping[str, str], units: Mapping[str, str]) -> Columns:
    """The columns of a table.

    chosen: heads, or numbers from 1, given by the user; units: units given by the user.
    """
    columns = Columns(notes=[*table.notes])
    test = _test(table, chosen)
    for quantity in SI:
        candidates = [k for k in _candidates(table, quantity, units.get(quantity)) if k in test]
        if quantity in chosen:
            candidates = _named(table, chosen[quantity])
        elif len(candidates) > 1 and not _are_same(table, quantity, candidates):
            heads = " or ".join(f'{quantity}="{_name(table, k)}"' for k in candidates)
            columns.questions.append(f"--columns {heads}: which is it?")
            columns.undecided.add(quantity)
            continue
        if candidates:
            _add(columns, table, quantity, candidates[0], units.get(quantity))
        elif quantity in units:
            raise MisfitError(f"--units {quantity} has no effect; {heads_of(table)}")
    _ask_for_units(columns)
    return columns


def _test(table: Table, chosen: Mapping[str, str]) -> range:
    """The columns of one test: all, unless several stand side by side, with the same heads each,
    and a column is chosen.
    """
    width = len(table.heads)
    heads = (*zip(table.heads, table.units, strict=True),)
    one = next(n for n in range(1, width + 1) if width % n == 0 and heads[:-n] == heads[n:])
    if one in (1, width) or not chosen:
        return range(width)
    first = one * min(_named(table, name)[0] // one for name in chosen.values())
    return range(first, first + one)


def _ask_for_units(columns: Columns) -> None:
    """Ask at once for the units of all columns that state none, or an unsuitable one."""
    if unknown := [quantity for quantity in columns.words if quantity not in columns.values]:
        words = " ".join(f"{quantity}={EXAMPLES[quantity]}" for quantity in unknown)
        heads = ", ".join(columns.words[quantity] for quantity in unknown)
        columns.questions.append(f"--units {words}, or other units: none are known of {heads}")
        columns.undecided.update(unknown)


def _add(columns: Columns, table: Table, quantity: str, k: int, stated_unit: str | None) -> None:
    """Add a column in SI, or only its words if its unit is not known."""
    head, unit = table.heads[k], stated_unit or table.units[k]
    if head == quantity == "strain" and not unit:
        unit = "1"
    size = size_in_si(unit, quantity) if unit else None
    name = shown(head) or f"column {k + 1}"
    columns.words[quantity] = f"{name} [{shown(unit)}]" if unit else name
    if size is not None:
        columns.values[quantity] = size * table.values[:, k]


def _candidates(table: Table, quantity: str, stated_unit: str | None) -> list[int]:
    """The columns that may be a quantity, by their words and units; constant ones are left out.

    If no unit fits, columns whose words fit and whose unit is not the unit of any quantity.
    """
    moving = [k for k in range(len(table.heads)) if _moves(table, k)]
    units = {k: stated_unit or table.units[k] for k in moving}
    columns = [k for k in moving if _may_be(table.heads[k], units[k], quantity)]
    if not columns:
        strange = [k for k in moving if all(size_in_si(units[k], name) is None for name in SI)]
        columns = [k for k in strange if _may_be(table.heads[k], "", quantity)]
    own = [k for k in columns if table.heads[k] == quantity]
    return own if len(own) == 1 else columns


def _moves(table: Table, k: int) -> bool:
    """Whether a column has different finite numbers."""
    values = table.values[:, k]
    finite = values[np.isfinite(values)]
    return bool(finite.size and np.ptp(finite) > 0.0)


def _may_be(head: str, unit: str, quantity: str) -> bool:
    """Whether words and unit of a head fit a quantity."""
    words = words_of(head)
    if set(words) & set(OTHERS.split()):
        return False
    if unit:
        fits = size_in_si(unit, quantity) is not None
        return fits and (not words or _is_called(words, quantity))
    called = [name for name in SI if _is_called(words, name)]
    return bool(called) and called[0] == quantity


def _is_called(words: list[str], quantity: str) -> bool:
    called, ends = words_of(WORDS[quantity]), ENDS.get(quantity, ())
    return any(word in called or word.endswith(ends) for word in words)


def words_of(head: str) -> list[str]:
    """The words of a head in lower case, without accents and numbers."""
    plain_letters = unicodedata.normalize("NFKD", CAMEL.sub(" ", head).lower())
    letters = "".join(c for c in plain_letters if not unicodedata.combining(c))
    return re.findall(r"[^\W\d_]+", letters)


def _are_same(table: Table, quantity: str, columns: list[int]) -> bool:
    """Whether columns have the same numbers in SI, from the first row on."""
    sizes = [size_in_si(table.units[k], quantity) or 1.0 for k in columns]
    values = table.values[:, columns] * sizes
    values = values[np.isfinite(values).all(axis=1)]
    if not values.size:
        return False
    moved = values - values[0]
    return bool(np.abs(moved - moved[:, :1]).max() < EQUAL * np.abs(moved).max())


def _named(table: Table, name: str) -> list[int]:
    """The column of a head or a number."""
    matches = [k for k, head in enumerate(table.heads) if head.lower() == name.strip().lower()]
    if not matches and name.isdecimal() and 0 < int(name) <= len(table.heads):
        matches = [int(name) - 1]
    if len(matches) != 1:
        raise MisfitError(f"--columns {shown(name)}: no such column; {heads_of(table)}")
    return matches


def _name(table: Table, k: int) -> str:
    """A unique name of a column: its head, or its number if it has no head, or one that others have
    too.
    """
    head = table.heads[k]
    return shown(head) if head and table.heads.count(head) == 1 else str(k + 1)


def heads_of(table: Table) -> str:
    """The heads of a table, in words, and which columns have one value and are therefore unused."""
    named = [k for k, head in enumerate(table.heads) if head]
    heads = [shown(table.heads[k]) + CONSTANT * (not _moves(table, k)) for k in named]
    if not heads:
        return f"its {len(table.heads)} columns have no heads, so that --units are needed too"
    more = f" and {len(heads) - MOST_HEADS} more" if len(heads) > MOST_HEADS else ""
    return f"its heads: {', '.join(heads[:MOST_HEADS])}{more}"


def shown(text: str) -> str:
    """A text from a file, made safe for a message."""
    text = plain(text)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
