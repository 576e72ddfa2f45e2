"""Effective materials as a table: units, turned axes, stresses that are never reached."""

from dataclasses import replace
from math import pi

from sweep.report.tables.card_sheet import TURNED, card_sheet
from tests.support.designs.effective import CARD


def row_of(card):
    sheet = card_sheet([card])
    return dict(zip(sheet.heads, sheet.rows[0], strict=True)), sheet


def test_numbers_are_in_their_units():
    row, sheet = row_of(CARD)
    assert (row["E1 MPa"], row["E2 MPa"], row["E3 MPa"], row["G12 MPa"]) == ("2", "1", "3", "0.05")
    assert (row["wall mm"], row["period mm"], row["filled %"]) == ("0.8", "4 x 5", "15.4")
    assert (row["buckling 1 kPa"], row["buckling 2 kPa"]) == ("6.41", "–")
    assert row["g/cm3"] == "0.183"
    assert "angle deg" not in row
    assert TURNED not in sheet.notes


def test_turned_axes_have_moduli_of_the_design_too():
    row, sheet = row_of(replace(CARD, angle=0.5 * pi))
    assert (row["angle deg"], row["E x MPa"], row["E y MPa"]) == ("90", "1", "2")
    assert TURNED in sheet.notes
