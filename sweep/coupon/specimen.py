"""Sizes of a specimen that a machine writes beside its table: "Cross-section", 7.3, "mm2"."""

from collections.abc import Iterator

from sweep.config.faults import MisfitError
from sweep.config.units import in_si
from sweep.coupon.columns import words_of
from sweep.coupon.table import Table, number
from sweep.coupon.unit import POWER

LABELS = {
    "gauge": ({"gauge", "gage", "anvil", "messlange"}, "m"),
    "area": ({"section", "area", "querschnitt", "flache", "crosssection"}, "m^2"),
}
"""Words of a label, of which one is enough, and the unit in SI."""
AFTER_THE_TEST = {"final", "end"}
L0 = "l0"  # a gauge length


def stated_size(table: Table, name: str) -> tuple[float, str] | None:
    """A size of the specimen in SI and its label, if the lines beside a table state one alone."""
    sizes = list(_sizes(table, *LABELS[name]))
    values = {value for value, _ in sizes}
    return sizes[0] if len(values) == 1 else None


def _sizes(table: Table, labels: set[str], unit: str) -> Iterator[tuple[float, str]]:
    for label, *cells in table.lines:
        words = set(words_of(label))
        named = words & labels or (L0 in label.lower() and unit == "m")
        if not named or words & AFTER_THE_TEST or len(cells) < 2:
            continue
        value = number(cells[0], table.decimal)
        try:
            written = POWER.sub(r"^\1", cells[1].strip("()[] "))
            size = in_si(f"{value} {written}", unit) if value else 0.0
        except MisfitError:
            continue
        if size > 0.0:
            yield size, label
