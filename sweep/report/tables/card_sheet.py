"""Effective materials of infills as a table of text."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, isfinite, pi
from typing import TYPE_CHECKING

from sweep.numbers import NOTHING, in_unit, significant
from sweep.report.tables.sheet import Sheet

if TYPE_CHECKING:
    from sweep.effective.material import EffectiveMaterial

NOTE = (
    "Of an endless infill of linear walls, at small strains, without perimeters.\n"
    "Axes 1 and 2: of the drawing; 3: along the walls. buckling: compressive stress of it."
)
TURNED = "angle: of axis 1 from the width. E x, E y: along the width and the height of the design."
DIGITS = 3


def card_sheet(cards: Sequence[EffectiveMaterial]) -> Sheet:
    """A row for each effective material."""
    turned = any(card.angle % pi for card in cards)
    heads = ["infill", "material", "wall mm", "period mm", "filled %"]
    heads += ["angle deg", "E x MPa", "E y MPa"] if turned else []
    heads += ["E1 MPa", "E2 MPa", "E3 MPa", "G12 MPa", "nu12", "buckling 1 kPa", "buckling 2 kPa"]
    heads += ["g/cm3"]
    rows = [_row(card, turned) for card in cards]
    notes = (NOTE, TURNED) if turned else (NOTE,)
    spare = ("material", "E3 MPa", "G12 MPa")
    return Sheet("", heads, rows, notes=notes, spare=spare, elsewhere="crumple card with --to .csv")


def _row(card: EffectiveMaterial, turned: bool) -> list[str]:
    across, along = (significant(in_unit(side, "mm"), DIGITS) for side in card.period)
    row = [card.name, card.material, _digits(in_unit(card.wall_thickness, "mm"))]
    row += [f"{across} x {along}", _digits(in_unit(card.relative_density, "%"))]
    if turned:
        row += [_digits(degrees(card.angle)), *map(_mega, (card.modulus_x, card.modulus_y))]
    row += map(_mega, (card.modulus_1, card.modulus_2, card.modulus_3, card.shear_12))
    row += [_digits(round(card.poisson_12, 4))]
    row += [_digits(in_unit(stress, "kPa")) for stress in card.buckling]
    return [*row, _digits(in_unit(card.density, "g/cm3"))]


def _mega(stress: float) -> str:
    return _digits(in_unit(stress, "MPa"))


def _digits(value: float) -> str:
    return significant(value, DIGITS) if isfinite(value) else NOTHING
