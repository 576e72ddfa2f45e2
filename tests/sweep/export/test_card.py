"""Cards for finite elements: their lines, their units, their names."""

import csv
import re
from dataclasses import replace
from math import pi

import pytest

from sweep.export.card import write_card
from sweep.export.errors import ExportError
from tests.support.designs.effective import CARD


def lines_of(cards, folder):
    """Keyword lines with the data lines below each; comments are left out."""
    text = write_card(cards, folder / "card.inp").read_text("utf-8")
    blocks = re.split(r"^(?=\*\w)", re.sub(r"^\*\*.*\n", "", text, flags=re.M), flags=re.M)
    return [block.splitlines() for block in blocks if block]


def test_the_text_has_nine_constants_density_and_axes(tmp_path):
    material, elastic, density, orientation = lines_of([replace(CARD, angle=pi / 6)], tmp_path)
    assert material == ["*MATERIAL, NAME=SQUARE_0P8MM_NINJAFLEX"]
    assert elastic[0] == "*ELASTIC, TYPE=ENGINEERING CONSTANTS"
    eight, ninth = elastic[1:]
    numbers = [*map(float, eight.split(",")), float(ninth)]
    assert numbers == pytest.approx([2.0, 1.0, 3.0, 0.0, 0.3, 0.15, 0.05, 0.6, 0.5])
    assert density[0] == "*DENSITY"
    assert float(density[1]) == pytest.approx(1.83e-10)  # t/mm3
    assert orientation[0].endswith("NAME=SQUARE_0P8MM_NINJAFLEX_AXES, SYSTEM=RECTANGULAR")
    axes = [float(number) for number in orientation[1].split(",")]
    assert axes == pytest.approx([0.75**0.5, 0.5, 0.0, -0.5, 0.75**0.5, 0.0])
    along = lines_of([replace(CARD, angle=0.5 * pi)], tmp_path)[-1]
    assert along[1] == "0, 1, 0., -1, 0, 0."


def test_names_begin_with_a_letter_and_differ(tmp_path):
    cards = [CARD, replace(CARD, material="../own file"), CARD, replace(CARD, name="x" * 90)]
    names = [block[0].partition("NAME=")[2] for block in lines_of(cards, tmp_path)[::4]]
    assert len({*names}) == len(names)
    assert all(re.fullmatch(r"[A-Z]\w{0,69}", name) for name in names)


def test_the_table_is_in_si(tmp_path):
    with write_card([CARD], tmp_path / "card.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert row["infill"] == "square"
    assert float(row["modulus_1_Pa"]) == pytest.approx(2e6)
    assert float(row["density_kg_per_m3"]) == 183.0
    assert row["buckling_2_Pa"] == "inf"


def test_another_ending_is_refused(tmp_path):
    with pytest.raises(ExportError, match=r"card\.xml: unknown ending; allowed: \.inp, \.csv"):
        write_card([CARD], tmp_path / "card.xml")
