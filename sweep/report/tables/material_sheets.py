"""Materials as tables of text: all of them, and one in full."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from sweep.config.materials.material_file import MEMORY, PLASTICITY
from sweep.config.materials.material_header import assumed, source
from sweep.numbers import NOTHING, in_unit, percent
from sweep.report.tables.sheet import Sheet

if TYPE_CHECKING:
    from sweep.config.materials.material_file import Record

SHOWN = {
    "modulus MPa": "modulus",
    "density kg/m3": "density",
    "poisson": "poisson",
    "after s": "reference_time",
    "loss": "loss",
    "softening r": "softening_r",
    "yield MPa": "yield_stress",
}
UNITS = {
    **dict.fromkeys(("modulus", "softening_m", "yield_stress", "hardening"), "MPa"),
    "density": "kg/m3",
    "reference_time": "s",
}
NOTE = (
    "after s: the time after loading for which the curve holds, if the material relaxes.\n"
    "+40, ±9: by how many percent a number may be off; crumple run --spread runs both ends.\n"
    "crumple materials NAME: all that the file of a material states, with its sources."
)


def material_sheet(records: Iterable[Record]) -> Sheet:
    """A row for each material, with the ranges of its numbers."""
    materials = list(records)
    keys = {
        head: key
        for head, key in SHOWN.items()
        if key not in (*MEMORY, *PLASTICITY)
        or any(key in (*record.memory, *record.plasticity) for record in materials)
    }
    rows = [
        [
            record.name,
            *(_with_range(record, key) for key in keys.values()),
            source(record.comments) or NOTHING,
            ", ".join(map(_first_word, assumed(record.comments))) or NOTHING,
        ]
        for record in materials
    ]
    heads, others = ["material", *keys, "source", "assumed"], "crumple materials NAME"
    return Sheet("", heads, rows, notes=(NOTE,), spare=("poisson", "after s"), elsewhere=others)


def _first_word(text: str) -> str:
    return text.split()[0].removesuffix("'s").lower()


def _with_range(record: Record, key: str) -> str:
    """A number of a material and its range, as text."""
    value = _value(record, key)
    if value is None:
        return NOTHING
    text = _digits(key, value)
    low, high = record.ranges.get(key, (value, value))
    less, more = (percent(abs(end / value - 1.0)) for end in (low, high))
    if less == more:
        return f"{text} ±{less}" if less != "0" else text
    below, above = (
        f"{sign}{end}" if end != "0" else "" for sign, end in zip("-+", (less, more), strict=True)
    )
    return f"{text} {' '.join(filter(None, (below, above)))}"


def _value(record: Record, key: str) -> float | None:
    if key == "reference_time" and record.plasticity:
        return None
    stated = {**record.memory, **record.plasticity}
    value: float | None = stated.get(key, getattr(record, key, None))
    return value


def number(record: Record, key: str) -> str:
    """A number of a material with its range, as text; a dash for a number it does not state."""
    value = _value(record, key)
    texts = [] if value is None else [_digits(key, value)]
    if key in record.ranges:
        low, high = (_digits(key, end) for end in record.ranges[key])
        texts.append(f"({low} .. {high})")
    return " ".join(texts) or NOTHING


def _digits(key: str, value: float) -> str:
    """A number of a material in the unit of its key."""
    return f"{in_unit(value, UNITS[key]) if key in UNITS else value:.4g}"


def details(record: Record) -> Iterator[str]:
    """All that the file of a material states, a line each."""
    yield from record.comments
    keys = dict.fromkeys(["modulus", "density", "poisson", "reference_time"])
    for key in keys | dict.fromkeys([*record.memory, *record.plasticity, *record.ranges]):
        yield f"{key.replace('_', ' '):16}{number(record, key)} {UNITS.get(key, '')}".rstrip()
    strain = record.strain
    if strain:
        yield f"{'curve':16}{len(strain)} points from {min(strain):g} to {max(strain):g} strain"
