"""Files that are no TOML: refused with the file, the line, and what is needed."""

import time

import pytest


def test_not_toml(lines, tmp_path):
    (line,) = lines("hello world")
    assert line.startswith(f"{tmp_path / 'sweep.toml'}: not TOML (Expected '='")


@pytest.mark.parametrize("text", ["", "\n # [lattice]\n"])
def test_an_empty_file_is_not_the_default_crush(lines, tmp_path, text):
    (line,) = lines(text)
    assert line.startswith(f"{tmp_path / 'sweep.toml'}: an empty config; ")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a = 1\nthis_line_is_a_note_without_a_hash", "line 2: this_line_is_a_note_without_a_hash"),
        ('a = [\n"0.4" mm"' + 30 * ', "1 mm"' + "\n]", 'line 2: "0.4" mm", "1 mm", "1 mm"'),
        ("cells = [4, 6\nrows = 3\n\n", "line 2: rows = 3"),
        ('a = """\nb = 1\n\n', "line 2: b = 1"),
        ('a = "\x1b[31m"', 'line 1: a = "?[31m'),
    ],
)
def test_line_at_which_the_parser_gives_up_is_told_at_once(lines, text, told):
    started = time.process_time()
    (line,) = lines(text)
    assert time.process_time() - started < 1.0
    assert told in line
    assert len(line.split("line ")[-1]) <= 64
