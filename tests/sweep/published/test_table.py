"""The table of crushes: it comes back as written, and faults are named with file and line."""

from dataclasses import replace

import pytest

from sweep.published.quantity import split_quantity
from sweep.published.table import (
    HEADS,
    OURS,
    PublishedError,
    Row,
    measured_range,
    read_table,
    with_row,
    write_table,
)

ROW = Row("a", "me, 2024", "energy, J", "friction", "a.toml", low="1", high="2", measured="3 +- 1")


def test_rows_come_back_as_written(tmp_path):
    file, other = tmp_path / "t.csv", replace(ROW, name="b", low="", high="", measured="")
    write_table(file, [ROW, other])
    assert read_table(file) == [ROW, other]
    assert ROW.comparison.measured == (2.0, 4.0)
    assert (other.comparison.predicted, other.comparison.measured) == (None, None)


@pytest.mark.parametrize(
    ("text", "expected"), [("0.7", (0.7, 0.7)), ("1 .. 2", (1, 2)), ("2 (1 .. 4)", (1, 4))]
)
def test_measured_values_have_ranges(text, expected):
    assert measured_range(replace(ROW, measured=text)) == expected


@pytest.mark.parametrize(
    ("changes", "wrong"),
    [
        ({"per": "0"}, "per = 0; allowed: a number above 0"),
        ({"per": "J"}, "per = J, low = 1, high = 2; allowed: numbers"),
        ({"measured": "about 3"}, "# measured: about 3 is no number; allowed: "),
    ],
)
def test_values_that_cannot_be_used_are_refused(tmp_path, changes, wrong):
    write_table(tmp_path / "t.csv", [replace(ROW, **changes)])
    with pytest.raises(PublishedError, match=rf"t\.csv, line 2: {wrong}"):
        read_table(tmp_path / "t.csv")


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("a,b\n", "heads a,b; needed: name,source"),
        (",".join(HEADS) + "\na,b\n", "line 2: 2 values; needed: 16"),
        (",".join(HEADS) + 2 * ("\na" + 15 * ",1") + "\n", "name a in two rows"),
        (None, "cannot be read"),
    ],
)
def test_other_tables_are_refused(tmp_path, text, wrong):
    if text is not None:
        (tmp_path / "t.csv").write_text(text)
    with pytest.raises(PublishedError, match=wrong):
        read_table(tmp_path / "t.csv")


def test_a_new_prediction_keeps_the_measured_value():
    rows = [ROW, replace(ROW, name="b")]
    again = replace(ROW, high="9", measured="")
    assert with_row(rows, again) == [replace(ROW, high="9"), rows[1]]
    assert with_row(rows, replace(again, measured="5"))[0].measured == "5"
    assert with_row(rows, replace(ROW, name="c"))[2].name == "c"


def test_words_find_rows():
    found = [row.name for row in read_table(OURS) if row.matches("DING")]
    assert found == ["ding plateau", "ding energy"]
    assert ROW.matches("2024")
    assert not ROW.matches("2025")


@pytest.mark.parametrize(
    ("text", "units", "number", "unit", "per"),
    [
        ("0.12 +- 0.018 J", "J", "0.12 +- 0.018", "J", 1.0),
        ("120 mJ", "J", "120", "mJ", 1e-3),
        ("0.078 .. 0.081 MPa", "Pa", "0.078 .. 0.081", "MPa", 1e6),
        ("3 (2 .. 4) kJ/m^3", "J/m^3", "3 (2 .. 4)", "kJ/m^3", 1e3),
        ("38 %", "1", "38", "%", 0.01),
        ("0.7", "1", "0.7", "", 1.0),
    ],
)
def test_number_and_unit_are_parted(text, units, number, unit, per):
    assert split_quantity(text, units) == (number, unit, pytest.approx(per))


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("0.12", 'a bare number; needed: a unit, such as "J"'),
        ("0.12 N", "a unit of another kind"),
        ("much", "no number"),
        ("1 +- J", "no number"),
    ],
)
def test_others_are_refused_with_what_is_allowed(text, wrong):
    with pytest.raises(PublishedError, match=f"--measured {text.replace('+', '.')}: ") as refusal:
        split_quantity(text, "J")
    assert wrong in str(refusal.value)
    assert "allowed: " in str(refusal.value)
