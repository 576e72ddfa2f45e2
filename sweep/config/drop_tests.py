"""Drop tests of standards: the mass and the height of `loading.preset`, from `drop_tests.csv`."""

import csv
import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

from sweep.config.faults import MisfitError
from sweep.config.units import in_si as quantity_in_si

PRESET = re.compile(r"(\S+)\s+(\S.*)")
FLAT = "flat striker at equal J/cm2"
"""The claim that a planar model allows for a test with a dome or a head form."""


class Drop(NamedTuple):
    """The falling body: its mass (kg), None if the preset does not state it, and its height (m)."""

    mass: float | None
    height: float


def in_si(preset: str) -> str:
    """A preset as a case holds it: the name of a test, a number and "kg" or "m".

    Raises `MisfitError` with the fault.
    """
    match = PRESET.fullmatch(preset)
    name = match[1] if match else preset
    limits(name)
    if match is None:
        raise MisfitError("neither a mass nor a height")
    try:
        text = f"{name} {quantity_in_si(match[2], 'kg'):.12g} kg"
    except MisfitError:
        text = f"{name} {quantity_in_si(match[2], 'm'):.12g} m"
    drop_of(text)
    return text


def drop_of(preset: str) -> Drop:
    """The drop of a preset: by the mass of the falling body, or by one of the heights of the
    test.
    """
    name, number, unit = preset.split()
    value, rows = float(number), limits(name)
    if unit == "m":
        if value not in [height for _, height in rows]:
            raise MisfitError(f"no height of {name}, which has {_heights(rows)}")
        return Drop(None, value)
    heights = [height for below, height in rows if 0.0 < value < below]
    if not heights:
        raise MisfitError(f"a mass that {name} does not have, which ends at {rows[-1][0]:g} kg")
    return Drop(value, heights[0])


def limits(name: str) -> list[tuple[float, float]]:
    """The rows of a test: the height (m) of the drop for masses (kg) below a limit."""
    if name not in drops():
        raise MisfitError("unknown test")
    if not drops()[name]:
        raise MisfitError(f"a flat planar model cannot claim {name}; simulate a {FLAT}")
    return drops()[name]


@cache
def drops() -> dict[str, list[tuple[float, float]]]:
    """The rows of all tests by name; none for tests whose striker or anvil is shaped."""
    text = (Path(__file__).parent / "drop_tests.csv").read_text("utf-8")
    tests: dict[str, list[tuple[float, float]]] = {}
    for row in csv.DictReader(line for line in text.splitlines() if line[0] != "#"):
        rows = tests.setdefault(row["test"], [])
        rows += [(float(row["below_kg"]), float(row["height_m"]))] if row["height_m"] else []
    return tests


def in_words() -> str:
    """The allowed presets, in words."""
    *others, last = [name for name, rows in drops().items() if rows]
    return (
        f'{", ".join(others)} or {last} with a mass or a height, such as "ista-1a 5 kg" or '
        '"mil-std-810 1.22 m"'
    )


def _heights(rows: list[tuple[float, float]]) -> str:
    return ", ".join(f"{height:g} m" for _, height in rows)
