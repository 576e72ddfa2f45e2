"""Units in the heads of a machine's columns: "Load (kN)", "Weg / mm", "stress_MPa", "[%]"."""

import re

from sweep.config.faults import MisfitError
from sweep.config.units import in_si

SI = {"time": "s", "displacement": "m", "strain": "1", "force": "N", "stress": "Pa"}
"""Quantity -> its SI unit."""
OTHER_NAMES = {
    **{name.lower(): name for name in ("N", "kN", "MN", "Pa", "kPa", "GPa", "mm", "ms")},
    "mpa": "MPa",
    "secs": "s",
    "lb": "lbf",
    "lbs": "lbf",
    "kg": "kgf",
    "ksi": "kpsi",
    "pct": "%",
    "-": "1",
}
"""Units as machines write them, in lower case -> as `sweep.config.units` reads them."""
BRACKETS = re.compile(r"\(([^()]*)\)|\[([^\[\]]*)\]|<([^<>]*)>")
BEFORE_UNIT = re.compile(r"\s+in\s+|\s*[/,]\s*|[\s_]")
POWER = re.compile(r"(?<=[a-zA-Z])([23])\b")
LONGEST = 12  # characters of a unit


def size_in_si(unit: str, quantity: str) -> float | None:
    """A unit over the SI unit of a quantity; None if it is no unit of this quantity."""
    written = POWER.sub(r"^\1", unit.strip())
    small = written.lower()
    for text in (written, OTHER_NAMES.get(small, small)):
        try:
            return in_si(f"1 {text}" if text != "1" else "1 mm/mm", SI[quantity])
        except MisfitError:
            continue
    return None


def is_unit(text: str) -> bool:
    """Whether a text is the unit of a quantity, or anything else in brackets."""
    inner = text.strip("()[]<> ")
    if len(inner) > LONGEST or inner.isdecimal():
        return False
    if len(text) > 1 and text[0] + text[-1] in ("()", "[]", "<>"):
        return True
    return any(size_in_si(inner, quantity) is not None for quantity in SI)


def unit_in_head(head: str) -> tuple[str, str]:
    """A head without its unit, and the unit; "" if it has none."""
    for match in BRACKETS.finditer(head):
        if is_unit(inner := next(filter(None, match.groups()), "")):
            return (head[: match.start()] + head[match.end() :]).strip(), inner.strip()
    for match in BEFORE_UNIT.finditer(head):
        words, unit = head[: match.start()].strip(), head[match.end() :]
        if words and unit[:1] not in tuple("([<") and is_unit(unit):
            return words, unit
    return head, ""
