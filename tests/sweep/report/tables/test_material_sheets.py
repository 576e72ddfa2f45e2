"""Materials as text: the table of all, and one in full."""

import pytest

from sweep.config.materials.material_file import available, locate, read_record
from sweep.report.tables.material_sheets import details, material_sheet, number
from tests.support.materials.records import HEADER

ROWS = "0.01,2e4\n0.05,1e5\n"


def test_every_material_has_a_row_with_ranges_and_assumptions():
    sheet = material_sheet(read_record(locate(name)) for name in available())
    table = {row[0]: dict(zip(sheet.heads, row, strict=True)) for row in sheet.rows}
    assert list(table) == available()
    ultimaker = table["ultimaker_tpu95a"]
    assert ultimaker["modulus MPa"] == "67 ±9"
    assert ultimaker["assumed"] == "curve, reference, poisson"
    assert table["polymaker_tpu90"]["density kg/m3"] == "1200 -1 +2"
    assert table["cheetah"]["poisson"] == "0.48 -6"
    assert all(row["source"] != "–" for row in table.values())
    assert "loss" not in sheet.heads


def test_loss_has_a_column_if_a_material_states_it(own_record):
    stated = read_record(own_record("# loss: 0.3\n" + HEADER + ROWS))
    sheet = material_sheet([stated, read_record(locate("cheetah"))])
    assert [row[sheet.heads.index("loss")] for row in sheet.rows] == ["0.3", "–"]
    assert sheet.rows[0][-2:] == ["–", "–"]


@pytest.mark.parametrize(
    ("key", "text"),
    [("modulus", "2"), ("softening_m", "0.1 (0.05 .. 0.2)"), ("friction", "(0.2 .. 0.9)")],
)
def test_numbers_are_in_the_units_of_makers(own_record, key, text):
    lines = "# softening_r: 2\n# softening_m_Pa: 1e5 (5e4 .. 2e5)\n# friction: 0.2 .. 0.9\n"
    assert number(read_record(own_record(lines + HEADER + ROWS)), key) == text


def test_details_are_all_that_a_file_states(own_record):
    lines = "# A spool.\n# Source: a test.\n# loss: 0.3\n# friction: 0.2 .. 0.9\n"
    found = [*details(read_record(own_record(lines + HEADER + ROWS)))]
    assert found[:2] == ["A spool.", "Source: a test."]
    assert [line.split("  ")[0] for line in found[2:]] == [
        *("modulus", "density", "poisson", "reference time", "loss", "friction", "curve")
    ]
    assert "curve           2 points from 0.01 to 0.05 strain" in found
