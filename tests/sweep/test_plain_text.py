"""Texts from elsewhere: on a terminal, and in a table that a spreadsheet opens."""

import pandas as pd
import pytest

from sweep.cli.terminal import hint, print_sheets, say
from sweep.plain_text import plain, without_formulas
from sweep.report.tables.sheet import Sheet
from sweep.running.progress import announce

STEERING = "a\x1b]0;title\x07\x1b[31mred\r\u202eb\u2028c\x9b"
WRITTEN = r"a\x1b]0;title\x07\x1b[31mred\r\u202eb\u2028c\x9b"


def test_what_steers_a_terminal_is_written_out():
    assert plain(STEERING) == WRITTEN
    assert plain("3 x 3 Zellen, 2\u00a0mm\n\u2713 \u65e5\u672c\tok") == (
        "3 x 3 Zellen, 2\u00a0mm\n\u2713 \u65e5\u672c\tok"
    )


@pytest.mark.parametrize("tell", [say, announce, lambda text: hint([text])])
def test_every_line_is_plain(tell, capsys):
    tell(STEERING)
    out, err = capsys.readouterr()
    assert WRITTEN in out + err
    assert "\x1b" not in out + err


def test_names_in_brackets_are_no_markup(capsys):
    """Rich would take them for a style, and leave them out."""
    print_sheets([Sheet(STEERING, ["tpu[bold]"], [["tpu[dry]"], ["tpu[wet]"], [STEERING]])])
    out = capsys.readouterr().out
    assert "\x1b" not in out
    for text in ("tpu[bold]", "tpu[dry]", "tpu[wet]", WRITTEN):
        assert text in out


def test_texts_that_begin_like_formulas_are_quoted():
    texts = ["=cmd|' /C calc'!A0", "+1+1", "@sum", "-x", "-3.5", "hex", "", "\t=1"]
    table = without_formulas(pd.DataFrame({"n": range(len(texts)), "text": texts}))
    assert list(table["text"]) == [
        "'=cmd|' /C calc'!A0", "'+1+1", "'@sum", "'-x", "-3.5", "hex", "", "'\t=1",
    ]  # fmt: skip
    assert list(table["n"]) == list(range(len(texts)))
