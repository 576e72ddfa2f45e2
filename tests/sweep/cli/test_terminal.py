"""The command line as a process: effects of its terminal, its pipes and its disk."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from sweep.cli.terminal import OF_THE_WHOLE, fitted, print_sheets, quoted
from sweep.report.tables.sheet import Sheet
from tests.support.command import crumple
from tests.support.results.specimens import summary, write

ROOT = Path(__file__).parents[3]


@pytest.fixture
def file(tmp_path):
    return write(tmp_path / "trial.h5", summary({}, {"status": "stopped"}))


def started(*arguments, **options):
    """A call in a process of its own, in a usual environment, and killed if it hangs."""
    usual = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "COLUMNS"))}
    options["env"] = usual | {"PYTHONPATH": str(ROOT)} | options.pop("env", {})
    command = [sys.executable, "-m", "sweep", *arguments]
    options.setdefault("stderr", subprocess.PIPE)
    return subprocess.run(command, text=True, timeout=60, check=False, **options)


@pytest.fixture
def nobody():
    read, pipe = os.pipe()
    os.close(read)
    with os.fdopen(pipe, "w") as closed:
        yield closed


def test_progress_that_nobody_reads_does_not_end_a_run(nobody):
    announced = "from sweep.running.progress import announce; announce('one'); announce('two')"
    command = [sys.executable, "-c", announced]
    assert subprocess.run(command, cwd=ROOT, stderr=nobody, check=False).returncode == 0


def test_disk_that_is_full(file):
    with Path("/dev/full").open("w") as full:
        done = started("status", file, stdout=full)
    assert done.returncode == 2
    assert done.stderr == "crumple status: [Errno 28] No space left on device\n"


def test_terminal_that_knows_only_ascii(tmp_path):
    file = write(tmp_path / "trial.h5", summary({"material": "gomme élastique"}, {}))
    ascii_only = {"PYTHONIOENCODING": "ascii"}
    done = started("show", file, stdout=subprocess.PIPE, env=ascii_only)
    assert (done.returncode, done.stderr) == (0, "")
    assert "gomme ?lastique" in done.stdout


HEADS = ["#", "cells", "material", "reference time s", "mass g", "peak N", "lost_energy_J"]
ROW = ["1*", "3 x 3", "soft and tough TPU", "0.001", "1.234", "123456", "0.123"]
SHEET = Sheet("", HEADS, [ROW, ROW], spare=("peak N", "mass g"))


@pytest.mark.parametrize(
    ("limit", "gap", "heads"),
    [
        (90, 2, HEADS),
        (72, 1, HEADS),
        (55, 1, HEADS),
        (42, 1, [head for head in HEADS if head != "peak N"]),
        (36, 1, [head for head in HEADS if head not in SHEET.spare]),
        (5, 1, [head for head in HEADS if head not in SHEET.spare]),
    ],
)
def test_a_table_is_made_to_fit_without_cutting_numbers(limit, gap, heads):
    shown = fitted(SHEET, limit)
    assert shown.sheet.heads == heads
    assert shown.gap == gap
    assert shown.width <= limit or limit == 5
    for head, width in zip(heads, shown.widths, strict=True):
        text = ROW[HEADS.index(head)]
        assert width >= (5 if head == "material" else len(text))


DESIGNS = Sheet(
    "",
    ["design", "wall mm", "cells", "material"],
    [
        ["hex", "0.8", "3 x 4", "soft and tough TPU [dry]"],
        ["a_word_without_blanks", "12.34", "4 x 4", "gomme élastique"],
        ["中文 infill", "> 3", "", ""],
    ],
    opens=frozenset({0, 2}),
)


@pytest.mark.parametrize("limit", [200, 40, 30, 24])
def test_rows_are_those_that_rich_prints(limit, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", str(limit))
    shown = fitted(DESIGNS, limit)
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, padding=(0, shown.gap - 1, 0, 0))
    sides = ("left", "right", "left", "left")
    for head, width, side in zip(shown.heads, shown.widths, sides, strict=True):
        table.add_column(Text(head), justify=side, width=width, overflow="fold")
    for number, row in enumerate(shown.sheet.rows):
        if number == 2:
            table.add_section()
        table.add_row(*map(Text, row))
    console = Console(width=1000)
    with console.capture() as text:
        console.print(table)
    print_sheets([DESIGNS])
    assert capsys.readouterr().out == f"\n{text.get()}\n"


def test_a_narrow_terminal_shows_whole_numbers_and_says_what_it_leaves_out(
    capsys, monkeypatch, tmp_path
):
    names = ("wall_thickness_m", "width_m", "depth_m", "mass_g")
    varied = [dict.fromkeys(names, size) for size in (1.23e-3, 2.34e-3)]
    long = {"material": "a_material_with_a_long_name", "peak_force_N": 12345.0}
    file = write(tmp_path / "trial.h5", summary(*(row | long for row in varied), {}))
    monkeypatch.delenv("COLUMNS", raising=False)
    tables = {}
    for columns in (None, 200, 80):
        if columns:
            monkeypatch.setenv("COLUMNS", str(columns))
        tables[columns] = crumple(capsys, "rank", file)[1].split("\n\n")[1]
    assert "Hidden" not in tables[200] + tables[None]
    assert "Hidden in this narrow terminal: dens. %, returned %. A wider" in tables[80]
    assert max(map(len, tables[80].splitlines())) <= 80
    for table in tables.values():
        assert "…" not in table
        assert table.count("12345") == 2


@pytest.mark.parametrize(
    ("system", "path", "written"),
    [
        ("linux", "my results/a.h5", "'my results/a.h5'"),
        ("win32", r"my results\a.h5", r'"my results\a.h5"'),
        ("win32", r"results\a.h5", r"results\a.h5"),
    ],
)
def test_a_path_is_quoted_as_the_shell_of_the_system_takes_it(monkeypatch, system, path, written):
    monkeypatch.setattr(sys, "platform", system)
    assert quoted(path) == written


def test_output_that_nobody_reads_or_that_is_closed_changes_no_exit_status(tmp_path, nobody):
    cases = [{"case_id": f"{k:016x}"} for k in range(1, 400)]
    file = write(tmp_path / "trial.h5", summary({"status": "stopped"}, *cases))
    ranked, refused = (["--top", "400"], 1), (["--by", "nothing"], 2)
    for (words, status), how in (
        (ranked, {"stdout": nobody}),
        (ranked, {"stdout": nobody, "stderr": nobody}),
        (ranked, {"preexec_fn": lambda: os.close(1)}),
        (ranked, {"preexec_fn": lambda: os.close(2)}),
        (refused, {"stdout": nobody, "stderr": nobody}),
        (refused, {"preexec_fn": lambda: os.close(2)}),
    ):
        done = started("rank", file, *words, **how)
        assert done.returncode == status
        assert not re.search("pipe|descriptor|Traceback", done.stderr or "")


def test_notes_are_broken_at_blanks_where_the_terminal_is_narrow(capsys, monkeypatch):
    note = "Some lattices have fewer than eight cells.\nShort."
    monkeypatch.delenv("COLUMNS", raising=False)
    print_sheets([DESIGNS._replace(notes=(note,))])
    assert note in capsys.readouterr().out
    monkeypatch.setenv("COLUMNS", "30")
    print_sheets([DESIGNS._replace(notes=(note,))])
    assert "Some lattices have fewer than\neight cells.\nShort.\n" in capsys.readouterr().out


def test_an_order_of_the_whole_crush_is_told_beside_an_allowed_force(capsys, tmp_path):
    table = summary({}, {"mass_g": 2.0}).assign(absorbed_energy_at_10N_J=0.01)
    file = write(tmp_path / "f.h5", table)
    asked = "rank", file, "--allowed-force", "10 N", "--brief"
    assert OF_THE_WHOLE in crumple(capsys, *asked, "--by", "absorbed_energy_J")[1]
    assert OF_THE_WHOLE not in crumple(capsys, *asked)[1]


def test_designs_that_densify_later_may_lead(capsys, tmp_path):
    table = summary({}, {"densification_strain": float("nan")})
    file = write(tmp_path / "f.h5", table)
    text = crumple(capsys, "rank", file, "--by", "densification_strain", "--brief")[1]
    assert "did not densify in their crush may lead" in text
