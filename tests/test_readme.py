"""What the README says: its commands, files, keys, columns, snippets and figures are real."""

import re
import shlex
from functools import cache
from pathlib import Path

import figures
import matplotlib.pyplot
import pytest

from sweep.__main__ import main, parser
from sweep.config import load_config
from sweep.grid import expand
from sweep.keys import case_keys, table_keys
from sweep.params import TABLES
from sweep.record import COLUMNS as RECORD
from sweep.result import COLUMNS

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text("utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
QUOTED = set(re.findall(r"`([^`\n]+)`", README))
OF_THE_USER = {"bumper.toml"}


def blocks(language):
    return [text for name, text in BLOCKS if name == language]


def rows_of(text):
    """Cells of the rows of Markdown tables, heads and rules included."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


@cache
def figures_now():
    """Rows of all tables of figures, by their names."""
    return {row[0]: row[1:] for table in figures.TABLES for row in table()}


def test_make_targets_exist():
    typed = re.findall(r"^make (\w+)", "\n".join(blocks("sh")), re.MULTILINE)
    quoted = [words.split()[1] for words in QUOTED if words.startswith("make ")]
    targets = re.findall(r"^(\w+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE)
    assert {"sweep", "test", "verify"} <= {*typed, *quoted} <= set(targets)


def test_commands_are_accepted():
    text = "\n".join([*blocks("sh"), *blocks("text")])
    commands = re.findall(r"^(?:\$ )?crumple (\w+ .*)", text, re.MULTILINE)
    verbs = [parser().parse_args(shlex.split(words, comments=True)).verb for words in commands]
    assert {*verbs} == {"run", "rank", "status", "show"}


def test_files_exist():
    named = {words for words in QUOTED if re.fullmatch(r"[\w./]+\.(py|toml|cff|md)", words)}
    missing = [
        name
        for name in named - OF_THE_USER
        if not any((ROOT / folder / name).is_file() for folder in ("", "kernels", "sweep"))
    ]
    assert missing == []
    assert len(named) > 20


def test_every_term_of_the_energy_is_named():
    paths = (ROOT / "kernels").glob("*.py")
    terms = {path.name for path in paths if "def energy(" in path.read_text("utf-8")}
    assert len(terms) > 8
    assert terms - {"step.py"} <= QUOTED
    assert "kernels/step.py" in QUOTED


def test_example_has_as_many_cases_as_it_says(tmp_path):
    path = tmp_path / "bumper.toml"
    path.write_text(blocks("toml")[0])
    config = load_config(path)
    (shown,) = re.findall(r"^crumple show \S+ (\w+)", "\n".join(blocks("sh")), re.MULTILINE)
    cases = expand(config)
    assert (config.name, len(cases)) == ("bumper", 8)
    assert sum(case.case_id.startswith(shown) for case in cases) == 1


@pytest.mark.parametrize("table", [*TABLES, "rank"])
def test_every_key_is_explained(table):
    known = table_keys(table) if table == "rank" else case_keys()
    (row,) = [row for row in rows_of(README) if row[0] == f"`[{table}]`"]
    fields = {name.split(".")[1] for name in known if name.startswith(f"{table}.")}
    assert fields - set(re.findall(r"`(\w+)`", row[1])) == set()


def test_columns_exist():
    named = {words for words in QUOTED if re.fullmatch(r"[a-z_]+_(J|N|g|m|Pa|s|J_per_g)", words)}
    assert {"mass_g", "absorbed_energy_J"} <= named <= {*COLUMNS, *RECORD}


def test_refusal_reads_so(tmp_path, capsys):
    path = tmp_path / "bumper.toml"
    path.write_text('[lattice]\nwall_thicknes = "0.8 mm"\ndepth = 12\n')
    assert main(["run", str(path)]) == 2
    assert capsys.readouterr().err in blocks("text")


def test_snippets_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "configs").symlink_to(ROOT / "configs")
    assert main(["run", "configs/smoke.toml"]) == 0
    capsys.readouterr()
    names = {}
    for snippet in blocks("python"):
        exec(snippet, names)
    matplotlib.pyplot.close("all")
    assert capsys.readouterr().out.startswith("converged")
    assert len(names["table"]) == len(names["summary"]) == 6


def test_figures_are_those_of_make_verify():
    told = {row[0]: row[1:] for row in rows_of(README)}
    for name in figures_now().keys() - set(figures.OF_THIS_RUN):
        for said, cell in zip(told[name], figures_now()[name], strict=True):
            assert values(said) == pytest.approx(values(cell), rel=0.01, abs=0.0), name
            assert errors(said) == pytest.approx(errors(cell), abs=0.2), name


def values(cell):
    """Numbers of a cell outside parentheses."""
    return [float(number) for number in re.findall(r"[\d.]+", re.sub(r"\(.*\)", "", cell))]


def errors(cell):
    """Numbers of a cell in parentheses, in per cent."""
    return [float(number) for number in re.findall(r"\(([-+][\d.]+) %\)", cell)]


def test_worst_book_is_below_a_millionth():
    left = figures_now()["energy left over / absorbed"]
    assert all(float(share) < 1e-6 for share in left)
    assert figures_now()["walls that cross"] == ["0"] * len(left)
    assert figures_now()["status"] == ["converged"] * len(left)
