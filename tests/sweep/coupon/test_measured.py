"""Time, strain and stress from columns, sizes and speed; rows without numbers."""

import numpy as np
import pytest

from sweep.config.faults import MisfitError
from sweep.coupon.answers import Answers
from sweep.coupon.columns import Columns, columns_of
from sweep.coupon.measured import measured, stated_size
from sweep.coupon.table import Table

UP = np.linspace(0.0, 1.0, 41)
RAW = (("time", "displacement", "force"), ("s", "mm", "N"))
READY = (("time", "strain", "stress"), ("s", "", "Pa"))


def read(heads, values, answers, preamble=()):
    """The measured curve, and the columns with notes and questions."""
    table = Table(*heads, np.column_stack(values), [*map(list, preamble)], ".", ())
    columns: Columns = columns_of(table, {}, {})
    return measured(table, columns, answers), columns


SIZES = {"gauge": 0.05, "area": 8e-6}


def test_sizes_of_the_file_are_used_and_told():
    lines = [("Section", "8", "mm2"), ("Gage length", "50", "mm")]
    found, columns = read(RAW, [UP, 50.0 * UP, 16.0 * UP], Answers(), lines)
    assert found.stress == pytest.approx(2e6 * UP)
    assert columns.notes[0] == "gauge 50 mm, from the line Gage length"
    assert columns.notes[1] == "area 8 mm2, from the line Section"
    other, _ = read(RAW, [UP, 50.0 * UP, 16.0 * UP], Answers(area=16e-6), lines)
    assert other.stress == pytest.approx(1e6 * UP)


def test_a_column_goes_before_what_is_divided_unless_a_size_is_given():
    heads = (("time", "strain", "stress", "displacement"), ("s", "1", "Pa", "mm"))
    values = [UP, 2.0 * UP, 1e6 * UP, 50.0 * UP]
    assert read(heads, values, Answers())[0].strain == pytest.approx(2.0 * UP)
    assert read(heads, values, Answers(gauge=0.05))[0].strain == pytest.approx(UP)


def test_time_follows_from_the_speed():
    zigzag = np.r_[UP, UP[::-1][1:]]
    heads = (("displacement", "force"), ("mm", "N"))
    found, columns = read(heads, [zigzag, zigzag], Answers(**SIZES, speed=1e-3))
    assert found.time[-1] == pytest.approx(2.0)
    assert columns.notes == ["time from the travel and its speed"]
    strained, _ = read((("strain", "stress"), ("", "Pa")), [UP, UP], Answers(gauge=0.05, speed=0.1))
    assert strained.time[-1] == pytest.approx(0.5)


def test_an_even_travel_follows_from_time_and_speed():
    found, columns = read((("time", "force"), ("s", "N")), [UP, UP], Answers(**SIZES, speed=0.01))
    assert found.strain == pytest.approx(0.2 * UP)
    assert columns.words["displacement"] == "time and an even speed"


@pytest.mark.parametrize(
    ("heads", "question"),
    [
        ((("displacement", "force"), ("mm", "N")), '--speed "150 mm/min" of the travel, or --col'),
        ((("time", "force"), ("s", "N")), '--speed "5 mm/min" of an even travel'),
    ],
)
def test_a_speed_that_is_missing_is_asked_for(heads, question):
    missing, columns = read(heads, [UP, UP], Answers(**SIZES))
    assert missing is None
    assert question in columns.questions[0]


def test_rows_without_numbers_and_of_the_same_time_are_left_out():
    time = UP.copy()
    time[5], holed = time[4], UP.copy()
    holed[9] = np.nan
    found, columns = read(READY, [time, holed, 1e6 * UP], Answers())
    assert found.time.size == UP.size - 2
    assert np.isfinite(found.strain).all()
    assert [note.rpartition(": ")[2] for note in columns.notes] == ["1 row", "1 row"]


HALF = np.where(UP > 0.4, np.nan, UP)


@pytest.mark.parametrize(
    ("time", "answers", "wrong"),
    [
        (UP, {"area": 1.0}, "--area has no effect, as there is a column of stress"),
        (UP, {"speed": 1.0}, "--speed has no effect, as there is a column of time"),
        (UP, {"gauge": 0.0}, "--gauge: 0 in SI; allowed: above 0"),
        (UP, {"speed": -1.0}, "--speed: -1 in SI; allowed: above 0"),
        (UP[::-1], {}, "does not increase from row 1 to row 2"),
        (HALF, {}, "complete rows of .*; needed: at least 20"),
    ],
)
def test_what_contradicts_the_columns_is_refused(time, answers, wrong):
    with pytest.raises(MisfitError, match=wrong):
        read(READY, [time, UP, UP], Answers(**answers))


def table(*rows, decimal="."):
    return Table(("a",), ("",), np.zeros((1, 1)), [list(row) for row in rows], decimal, ())


@pytest.mark.parametrize(
    ("row", "name", "size"),
    [
        (("Cross-section", "7.335", "mm²"), "area", 7.335e-6),
        (("L0 - course standard", "25", "mm"), "gauge", 0.025),
        (("Specimen properties : Anvil height", "3.11", "mm"), "gauge", 3.11e-3),
        (("Final area", "7.3", "mm2"), "area", None),
        (("Area", "7.3", "mm"), "area", None),
        (("Area", "-7.3", "mm2"), "area", None),
        (("Area", "", "mm2"), "area", None),
        (("Gauge",), "gauge", None),
    ],
)
def test_a_size_is_read_by_its_label_and_unit(row, name, size):
    found = stated_size(table(row), name)
    assert found == (size and (pytest.approx(size), row[0]))


def test_decimal_commas_and_several_sizes():
    assert stated_size(table(("Area", "7,5", "mm2"), decimal=","), "area") == (7.5e-6, "Area")
    assert stated_size(table(("Area", "7", "mm2"), ("Section", "8", "mm2")), "area") is None
