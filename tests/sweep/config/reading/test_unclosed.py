"""What is not closed in a config, and in which line it begins."""

import tomllib

import pytest

from sweep.config.reading.examples import FOLDER
from sweep.config.reading.unclosed import unclosed

OPEN = [
    ("a = 1\ncells = [4, 6\nrows = [2, 3]\n", "line 2, cells = [4, 6: the list", "]"),
    ('"lattice.cells_x" = [\n4,\n\n[b]\nc = 3', 'line 1, "lattice.cells_x" = [: the list', "]"),
    ("a = [[1, 2], [3, 4]\nb = 3", "line 1, a = [[1, 2], [3, 4]: the list", "]"),
    ("a = [1}\n", "line 1, a = [1}: the list", "]"),
    ('a = "0.8 mm\nb = 1', 'line 1, a = "0.8 mm: the text', '"'),
    ("a = '0.8 mm", "line 1, a = '0.8 mm: the text", "'"),
    ('a = 1\nb = """x\ny', 'line 2, b = """x: the text', '"""'),
    ("a = {b = 1\nc = 2", "line 1, a = {b = 1: the table", "}"),
    ("[grid\na = 1", "line 1, [grid: the name of a table", "]"),
]


@pytest.mark.parametrize(("text", "told", "missing"), OPEN)
def test_first_thing_that_is_open_is_told_with_its_line(text, told, missing):
    with pytest.raises(tomllib.TOMLDecodeError):
        tomllib.loads(text)
    assert unclosed(text) == f"{told} that begins there is not closed; missing: {missing}"


@pytest.mark.parametrize(
    "text",
    [
        'a = ["x]", # [ "\n "y\\"["]\n[b]\nc = {d = [1, 2], e = "}"}',
        """a = '''[ { "'''\nb = \"\"\"it's\n[\"\"\" """,
        "[[zip]]\na.b = [\n 1, # first\n 2,\n]\n",
    ],
)
def test_what_is_closed_is_not_told(text):
    tomllib.loads(text)
    assert unclosed(text) is None


def test_nothing_is_open_in_what_is_shipped():
    texts = [path.read_text("utf-8") for path in FOLDER.rglob("*.toml")]
    assert [unclosed(text) for text in texts] == [None] * len(texts)


def test_long_line_is_shortened():
    long = "a = [" + 50 * "1, "
    told = unclosed(long)
    assert told is not None
    assert told.startswith(f"line 1, {long[:57]}...: the list")
