"""Sheets as text in Markdown: columns of equal width, notes below."""

from sweep.ranking.rank import ranked
from sweep.report.tables.markdown import markdown
from sweep.report.tables.sheet import Sheet
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import designs, summary


def test_budgets_stand_one_below_the_other_in_markdown():
    table = summary(*designs([1.0, 2.0, 3.0], [0.1, 0.3, 0.2]), {"cells_x": 4, "mass_g": 9.0})
    ranking = ranked(table, budget=["0.5 g", "1 g", "2 g"])
    text = markdown(ranking_sheets(ranking, table))
    assert text == (
        "### crushed to 50 %, glued platens\n\n"
        "| up to g | #  | cells | mass g | absorbs mJ | J/g   | peak N | pack % | back % |\n"
        "| ------- | -- | ----- | ------ | ---------- | ----- | ------ | ------ | ------ |\n"
        "| 1       | 1* | 3 x 3 | 1.00   | 100        | 0.100 | 20.0   | 54     | 0      |\n"
        "| 2       | 1* | 3 x 3 | 2.00   | 300        | 0.150 | 20.0   | 54     | 0      |\n"
        "|         | 2* | 3 x 3 | 1.00   | 100        | 0.100 | 20.0   | 54     | 0      |\n\n"
        "Nothing weighs 0.5 g or less: the lightest weighs 1 g, "
        "case 0000000000000000, cells 3 x 3.\n"
    )


def test_a_sheet_without_a_table_has_its_notes_alone():
    assert markdown([Sheet("", [], [], notes=("Nothing.",))]) == "Nothing.\n"
    assert markdown([Sheet("scene", [], [], notes=("Nothing.",))]) == "### scene\n\nNothing.\n"


def test_sheets_follow_one_another():
    sheets = [Sheet("one", ["a", "bcd"], [["10", "2"]]), Sheet("", ["e"], [["f"]], notes=("g",))]
    assert markdown(sheets).splitlines() == [
        *("### one", "", "| a  | bcd |", "| -- | --- |", "| 10 | 2   |"),
        *("", "| e |", "| - |", "| f |", "", "g"),
    ]
