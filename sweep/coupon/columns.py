"""Which column of a machine's table is time, displacement, strain, force or stress, and its unit.

The words of a head say what it may be, its unit which of it. Of several columns that may be the
same, the user is asked, unless they are in proportion.
"""

import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from sweep.config.faults import MisfitError
from sweep.coupon.table import Table
from sweep.coupon.unit import SI, size_in_si
from sweep.plain_text import plain

Floats = NDArray[np.float64]

WORDS = {
    "time": "time zeit temps tiempo tempo t 时间 時間",
    "force": "force load kraft charge last carga fuerza forza f 力 试验力 試験力 負荷 载荷",
    "displacement": "displacement extension crosshead travel stroke position disp weg traverse "
    "course deplacement extensometer elongation allongement deformation deform verformung "
    "desplazamiento spostamento 位移 变形 変位 ストローク",
    "strain": "strain dehnung stauchung deformation deform elongation extension extensometer "
    "allongement 应变 ひずみ",
    "stress": "stress spannung contrainte tension 应力 応力",
}
"""Words in a head, without accents -> what it may be."""
ENDS = {"time": "zeit", "force": "kraft", "displacement": "weg", "stress": "spannung"}
"""Ends of words in German."""
OTHERS = (
    "rate speed velocity true max maximum peak lateral transverse transversal width breite "
    "temperature command target setpoint work energy modulus break count cycles"
)
"""Words of what else a machine records."""
PROPORTIONAL = 0.01  # of the range of a column: it tells nothing else than another one
LONGEST = 40  # characters of a head that are shown
MOST_HEADS = 8  # heads that a message lists
EXAMPLES = {"time": "s", "displacement": "mm", "strain": "%", "force": "N", "stress": "MPa"}


@dataclass
class Columns:
    """The columns of a table by what they are, in SI, and what was found on the way.

    words: their heads, with units. notes: sentences on how they were read. questions: what could
    not be decided, with the option that decides it. undecided: of these, what is asked for already.
    """

    values: dict[str, Floats] = field(default_factory=dict)
    words: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    questions: list[str] = field(default_factory=list)
    undecided: set[str] = field(default_factory=set)


def columns_of(table: Table, chosen: Mapping[str, str], units: Mapping[str, str]) -> Columns:
    """The columns of a table.

    chosen: heads, or numbers from 1, that the user has given; units: units likewise.
    """
    found = Columns(notes=[*table.notes])
    for quantity in SI:
        candidates = _candidates(table, quantity, units.get(quantity))
        if quantity in chosen:
            candidates = _named(table, chosen[quantity])
        elif len(candidates) > 1 and not _same(table.values[:, candidates]):
            heads = " or ".join(f'{quantity}="{_name(table, k)}"' for k in candidates)
            found.questions.append(f"--columns {heads}: which is it?")
            found.undecided.add(quantity)
            continue
        if candidates:
            _add(found, table, quantity, candidates[0], units.get(quantity))
        elif quantity in units:
            raise MisfitError(f"--units {quantity} has no effect; {heads_of(table)}")
    return found


def _add(found: Columns, table: Table, quantity: str, k: int, given: str | None) -> None:
    """Add a column in SI, or the question of its unit."""
    head, unit = table.heads[k], given or table.units[k]
    if head == quantity == "strain" and not unit:
        unit = "1"
    size = size_in_si(unit, quantity) if unit else None
    name = shown(head) or f"column {k + 1}"
    found.words[quantity] = f"{name} [{shown(unit)}]" if unit else name
    if size is None:
        wrong = f"{shown(unit)} is no unit of it" if unit else "its unit is not stated"
        example = f"--units {quantity}={EXAMPLES[quantity]}"
        found.questions.append(f"{example} or the like: of {name}, {wrong}")
        found.undecided.add(quantity)
        return
    found.values[quantity] = size * table.values[:, k]


def _candidates(table: Table, quantity: str, given: str | None) -> list[int]:
    """The columns that may be a quantity, by their words and units; constant ones are left out."""
    columns = [
        k
        for k, (head, unit) in enumerate(zip(table.heads, table.units, strict=True))
        if _may_be(head, given or unit, quantity) and np.ptp(_known(table.values[:, k])) > 0.0
    ]
    own = [k for k in columns if table.heads[k] == quantity]
    return own if len(own) == 1 else columns


def _known(values: Floats) -> Floats:
    known = values[np.isfinite(values)]
    return known if known.size else np.zeros(1)


def _may_be(head: str, unit: str, quantity: str) -> bool:
    """Whether words and unit of a head allow that it is a quantity."""
    words = words_of(head)
    if set(words) & set(OTHERS.split()):
        return False
    if unit:
        fits = size_in_si(unit, quantity) is not None
        return fits and (not words or _is_called(words, quantity))
    called = [name for name in SI if _is_called(words, name)]
    return bool(called) and called[0] == quantity


def _is_called(words: list[str], quantity: str) -> bool:
    known, end = words_of(WORDS[quantity]), ENDS.get(quantity)
    return any(word in known or (end is not None and word.endswith(end)) for word in words)


def words_of(head: str) -> list[str]:
    """The words of a head in small letters, without accents and numbers."""
    plain_letters = unicodedata.normalize("NFKD", head.lower())
    letters = "".join(c for c in plain_letters if not unicodedata.combining(c))
    return re.findall(r"[^\W\d_]+", letters)


def _same(values: Floats) -> bool:
    """Whether columns (n, k) are in proportion, from the first row on."""
    moved = values - values[0]
    spans = np.nanmax(np.abs(moved), axis=0)
    first = moved[:, 0] / spans[0]
    apart = [np.nanmax(np.abs(first - moved[:, k] / spans[k])) for k in range(1, spans.size)]
    return max(apart) < PROPORTIONAL


def _named(table: Table, name: str) -> list[int]:
    """The column of a head or a number."""
    matches = [k for k, head in enumerate(table.heads) if head.lower() == name.strip().lower()]
    if not matches and name.isdecimal() and 0 < int(name) <= len(table.heads):
        matches = [int(name) - 1]
    if len(matches) != 1:
        raise MisfitError(f"--columns {shown(name)}: no such column; {heads_of(table)}")
    return matches


def _name(table: Table, k: int) -> str:
    """What names a column alone: its head, or its number if it has none, or others have it too."""
    head = table.heads[k]
    return shown(head) if head and table.heads.count(head) == 1 else str(k + 1)


def heads_of(table: Table) -> str:
    """The heads of a table, in words."""
    heads = [shown(head) for head in table.heads if head]
    if not heads:
        return f"it has {len(table.heads)} columns without heads"
    more = f" and {len(heads) - MOST_HEADS} more" if len(heads) > MOST_HEADS else ""
    return f"its heads: {', '.join(heads[:MOST_HEADS])}{more}"


def shown(text: str) -> str:
    """A text of a file as a message may show it."""
    text = plain(text)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
