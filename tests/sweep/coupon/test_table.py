"""The table in a text: where it begins, its heads and units, which sign is a decimal one."""

import numpy as np
import pytest

from sweep.config.faults import MisfitError
from sweep.coupon.table import FEWEST, number, read_table

ROWS = np.column_stack([np.arange(30.0), 0.5 * np.arange(30.0), -1e3 * np.arange(30.0)])


@pytest.fixture
def table(tmp_path):
    """The table of a text."""

    def of(text, coding="utf-8"):
        path = tmp_path / "export.csv"
        path.write_bytes(text.encode(coding))
        return read_table(path)

    return of


def lines(separator=",", decimal=".", form="{:.2f}"):
    rows = (separator.join(form.format(v).replace(".", decimal) for v in row) for row in ROWS)
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize(
    ("separator", "decimal"),
    [(",", "."), (";", ","), (";", "."), ("\t", ","), ("\t", "."), (" ", "."), (", ", ".")],
)
def test_the_form_is_that_of_most_numbers(table, separator, decimal):
    heads = separator.join(["time_s", "way_mm", "F_N"])
    found = table(f"{heads}\n{lines(separator, decimal)}")
    assert found.values == pytest.approx(ROWS)
    assert (found.heads, found.units) == (("time", "way", "F"), ("s", "mm", "N"))


def test_quoted_decimal_commas_between_commas(table):
    assert table("a,b,c\n" + lines(",", ",", '"{:.3f}"')).values == pytest.approx(ROWS)


def test_lines_above_and_below_are_told_from_the_table(table):
    head = 'Width,5.96,"mm"\nx" y\n"Time","Load","Temp"\n"s","N","°C"\n'
    found = table("\ufeff" + head + lines() + "Mean,1\n1,2,3\n4,5,6\n")
    assert found.lines[0] == ["Width", "5.96", "mm"]
    assert (found.heads, found.units) == (("Time", "Load", "Temp"), ("s", "N", "°C"))
    assert found.values.shape == ROWS.shape
    assert found.notes[1].endswith("not read: 2 further rows of numbers")


def test_lines_below_the_numbers_belong_to_the_test(table):
    found = table("time_s,way_mm,force_N\n" + lines() + "\nDirection:,COMPRESSION\n")
    assert found.lines == [["time_s", "way_mm", "force_N"], ["Direction:", "COMPRESSION"]]


def test_comments_are_left_out_unless_they_are_the_heads(table):
    found = table("# 1, 2\ntime_s,way_mm,force_N\n# pause\n" + lines())
    assert found.heads == ("time", "way", "force")
    assert found.values == pytest.approx(ROWS)
    assert table("# time_s,way_mm,force_N\n" + lines()).units == ("s", "mm", "N")


def test_missing_numbers_and_words_in_rows_are_nan(table):
    text = lines().replace("2.00,1.00,-2000.00", "2.00,,-2000.00").replace("3.00,1.50", "3.00,x")
    found = table("a,b,c\n" + text)
    assert np.isnan(found.values[2:4, 1]).all()
    assert np.isfinite(found.values[4:]).all()


def test_numbers():
    cases = {("1,5", ","): 1.5, ("1.234,5", ","): 1234.5, ("1,234.5", "."): 1234.5}
    cases |= {("-1e-3", "."): -1e-3, ("\N{MINUS SIGN}2", "."): -2.0, ("0,100", "."): None}
    cases |= {("1e999", "."): None, ("1_000", "."): None, ("nan", "."): None, ("12:30", "."): None}
    assert {key: number(*key) for key in cases} == cases


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("", "no rows of numbers"),
        ("a,b\n" + "1,2\n" * (FEWEST - 1), f"{FEWEST - 1} rows of numbers: too few"),
        ("a,b\n" + "1,2,3\n" * FEWEST, "rows have 3 values, but there are 2 heads"),
        ("a,b\n" + "1," + "2" * 200_000 + "\n", "a value of more than 131,072 characters"),
    ],
)
def test_what_is_no_table_is_refused(table, text, wrong):
    with pytest.raises(MisfitError, match=wrong):
        table(text)
