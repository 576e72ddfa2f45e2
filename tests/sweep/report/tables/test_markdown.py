"""Sheets as text in Markdown: columns of equal width, notes below."""

import re

from sweep.ranking.rank import ranked
from sweep.report.tables.markdown import markdown
from sweep.report.tables.sheet import Sheet
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import designs, summary


def test_budgets_stand_one_below_the_other_in_markdown():
    table = summary(*designs([1.0, 2.0, 3.0], [0.1, 0.3, 0.2]), {"cells_x": 4, "mass_g": 9.0})
    sheets = ranking_sheets(ranked(table, budget=["0.5 g", "1 g", "2 g"]), table)
    title, _, heads, _, *rows = markdown(sheets).splitlines()
    assert title == "### crushed to 50 %, glued platens"
    cells = [[cell.strip() for cell in row.split("|")[1:5]] for row in (heads, *rows[:3])]
    assert cells == [
        ["up to g", "#", "cells", "mass g"],
        ["1", "1*", "3 x 3", "1.00"],
        ["2", "1*", "3 x 3", "2.00"],
        ["", "2*", "3 x 3", "1.00"],
    ]
    assert len({len(row) for row in (heads, *rows[:3])}) == 1
    assert rows[3] == ""
    assert rows[4].startswith("No design weighs 0.5 g or less")


def test_sheets_follow_one_another_and_one_without_a_table_has_its_notes_alone():
    sheets = [Sheet("one", ["a", "bcd"], [["10", "2"]]), Sheet("", ["e"], [["f"]], notes=("g",))]
    assert markdown(sheets).splitlines() == [
        *("### one", "", "| a  | bcd |", "| -- | --- |", "| 10 | 2   |"),
        *("", "| e |", "| - |", "| f |", "", "g"),
    ]
    assert markdown([Sheet("", [], [], notes=("Nothing.",))]) == "Nothing.\n"
    assert markdown([Sheet("scene", [], [], notes=("Nothing.",))]) == "### scene\n\nNothing.\n"


def test_names_end_no_cell_and_begin_no_tag():
    text = markdown([Sheet("", ["a|b", "c"], [["<img src=x>", "< 1 %"], ["two\nlines", "d"]])])
    rows = [line for line in text.splitlines() if line]
    assert len(rows) == 4
    assert all(len(re.split(r"(?<!\\)\|", row)) == 4 for row in rows)
    assert "<img" not in text
    assert "< 1 %" in text
