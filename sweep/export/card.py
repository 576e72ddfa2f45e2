"""Writes effective materials for finite elements: the text of CalculiX and Abaqus, or CSV in SI."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import cos, sin
from pathlib import Path
from typing import TYPE_CHECKING

from sweep.export.errors import ExportError
from sweep.numbers import in_unit
from sweep.version import __version__
from sweep.whole_file import write_whole

if TYPE_CHECKING:
    from sweep.effective.material import EffectiveMaterial

LONGEST = 60  # letters of a name: 80 in CalculiX, including the number of equal ones
CONSTANTS = ("modulus_1", "modulus_2", "modulus_3", "poisson_12", "poisson_13", "poisson_23",
             "shear_12", "shear_13", "shear_23")  # fmt: skip
"""In the order of ENGINEERING CONSTANTS, eight in the first line."""


def write_card(cards: Sequence[EffectiveMaterial], path: Path) -> Path:
    """Write cards as .inp (N, mm, t, MPa) or .csv (SI)."""
    writers = {".inp": _inp, ".csv": _csv}
    if path.suffix not in writers:
        raise ExportError(f"{path}: unknown ending; allowed: {', '.join(writers)}")
    return write_whole(path, "".join(f"{line}\n" for line in writers[path.suffix](cards)))


def _inp(cards: Sequence[EffectiveMaterial]) -> Iterator[str]:
    """Materials with their axes, and stresses at which their walls buckle as comments."""
    yield f"** Effective materials of endless infills, Crumple {__version__}"
    yield "** Units: N, mm, t, MPa. Linear walls, small strains. Axis 3: along the walls."
    for name, card in zip(_names(cards), cards, strict=True):
        first, second = (in_unit(stress, "MPa") for stress in card.buckling)
        filled = in_unit(card.relative_density, "%")
        yield f"** {card.name} of {card.material}, {filled:.4g} % filled"
        yield f"** walls buckle at {first:.5g} MPa along axis 1, at {second:.5g} MPa along axis 2"
        yield f"*MATERIAL, NAME={name}"
        yield "*ELASTIC, TYPE=ENGINEERING CONSTANTS"
        *eight, last = (_constant(card, key) for key in CONSTANTS)
        yield ", ".join(eight)
        yield last
        yield "*DENSITY"
        yield f"{in_unit(card.density, 't/mm3'):.6e}"
        yield f"*ORIENTATION, NAME={name}_AXES, SYSTEM=RECTANGULAR"
        c, s = (round(part, 12) + 0.0 for part in (cos(card.angle), sin(card.angle)))
        yield f"{c:.9g}, {s:.9g}, 0., {0.0 - s:.9g}, {c:.9g}, 0."


def _constant(card: EffectiveMaterial, key: str) -> str:
    value = getattr(card, key)
    number = value if key.startswith("poisson") else in_unit(value, "MPa")
    return f"{0.0 if abs(number) < 1e-12 else number:.6g}"


def _names(cards: Sequence[EffectiveMaterial]) -> Iterator[str]:
    """A unique name of letters, digits and underscores for each card."""
    names: set[str] = set()
    for card in cards:
        words = f"{card.name}_{in_unit(card.wall_thickness, 'mm'):.3g}mm_{card.material}"
        name = re.sub(r"\W+", "_", words.replace(".", "p"), flags=re.ASCII).upper()[:LONGEST]
        number, unique = 2, name
        while unique in names:
            unique, number = f"{name}_{number}", number + 1
        names.add(unique)
        yield unique


def _csv(cards: Sequence[EffectiveMaterial]) -> Iterator[str]:
    """One row for each card."""
    rows = [card.row() for card in cards]
    yield ",".join(rows[0])
    for row in rows:
        yield ",".join(_cell(value) for value in row.values())


def _cell(value: float | str) -> str:
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"'
    return f"{value:.9g}"
