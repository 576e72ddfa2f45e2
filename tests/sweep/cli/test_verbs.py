"""The command line: its answers, its refusals, and its exit status."""

import errno
import io
import json
import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pandas as pd
import pytest

from sweep.cli.parser import parser
from sweep.cli.refusals import ArgumentError, writing
from sweep.cli.verbs import VERBS
from sweep.columns import absorbed_energy_column
from sweep.running.sweep import Interrupted
from sweep.store.read import read_summary
from tests.support.command import crumple
from tests.support.results.specimens import designs, summary, write


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """Five designs, two of which failed in the same way."""
    rows = designs([1.0, 2.0, 4.0, 1.0, 1.0], [0.1, 0.3, 0.4, 0.0, 0.0])
    for row, strain in zip(rows[3:], ["0.5", "0.41"], strict=True):
        row |= {"status": "stopped", "message": f"stopped at strain {strain} in 4: smaller steps"}
    config = {"rank": {"budgets": [0.002], "panel": None}}
    attributes = {"config": json.dumps(config), "git_revision": "abc123", "version_numpy": "9.9"}
    return write(tmp_path_factory.mktemp("cli") / "trial.h5", summary(*rows), attributes)


def test_every_verb_has_its_arguments_its_function_and_an_example(capsys):
    _, shown, _ = crumple(capsys, "--help")
    without = [verb for verb in VERBS if f"crumple {verb} " not in shown]
    assert not without, "EXAMPLES has no example of these verbs"
    _, _, told = crumple(capsys, "fly")
    said = re.findall(r"\w+", told.split("allowed: ")[1].splitlines()[0])
    assert said == list(VERBS), "parser has other verbs than ALL, or in another order"


@pytest.mark.parametrize("module", ["crumple", "sweep"])
def test_version_is_printed_without_a_verb(module):
    words = [sys.executable, "-m", module, "--version"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == (f"crumple {version('crumple')}\n", "")


REFUSED = [
    (["fly"], "fly: no verb; allowed: run, "),
    (["rnk"], "rnk: no verb; the nearest is rank; allowed: run, "),
    (["rank"], "required: F.h5"),
    (["rank", "nowhere.h5"], "nowhere.h5"),
    (["status", "nowhere.h5"], "nowhere.h5"),
    (["rank", "FILE", "--budget", "25"], "a bare number"),
    (["rank", "FILE", "--budget", "25 mm"], "another kind"),
    (["rank", "FILE", "--budget", "-1 oz"], "-1 oz: budgets, "),
    (["rank", "FILE", "--drop-height", "1 m"], "into a folder"),
    (["rank", "FILE", "--out", "F", "--drop-height", "1"], "a bare number"),
    (["rank", "FILE", "--out", "F", "--drop-height", "0 m"], "above zero"),
    (["rank", "FILE", "--panel", "100 mm"], 'with specimens: "100 mm" "50 mm")'),
    (["rank", "FILE", "--by", "peak_forse_N"], "the nearest are peak_force_N, "),
    (["rank", "FILE", "--top", "0"], "1 or more"),
    (["rank", "FILE", "--max-force", "60"], "a bare number"),
    (["rank", "FILE", "--max-deceleration", "60 g"], '"g" is a unit of another kind'),
    (["rank", "FILE", "--per", "piece"], "invalid choice"),
    (["rank", "FILE", "--per", "panel"], 'per "panel" needs a panel'),
    (["rank", "FILE", "--csv", "--json"], "not allowed with"),
    (["show", "FILE", "zz"], 'no case "zz"'),
    (["export", "FILE", "zz", "--to", "a.stl"], 'no case "zz"'),
    (["show", "FILE", ""], 'no case ""; allowed: a number in the ranking, from 1, or'),
    (["show", "FILE", "0"], "up to 2 g; allowed: 1 to 2, or the beginning of an id"),
    (["export", "FILE", "00", "--to", "a.stl"], "begins 5 ids: 0000000000000000"),
    (["export", "FILE", "0000000000000000"], "required: --to"),
    (["export", "FILE", "0000000000000000", "--to", "a.step"], "a.step: .step is unknown; allow"),
    (["export", "FILE", "0000000000000000", "--to", "a.stl"], "holds no usable case 00"),
    (["export", "FILE", "0000000000000000", "--to", "a.3mf", "--kind", "x"], "invalid choice: 'x'"),
    (["export", "FILE", "0000000000000000", "--to", "/proc/a.csv"], "a.csv cannot be written: "),
    (["export", "FILE", "0000000000000000", "--to", "FILE/a.csv"], "lies in a file; allow"),
    (["run", "nowhere.toml"], "nowhere.toml"),
    (["run", "smok"], "an example, such as smoke"),
    (["run", "nowhere.toml", "--workers", "none"], "1 or more"),
    (["run", "nowhere.toml", "--workers", "2", "--scheduler", "tcp://a:1"], "not allowed with"),
    (["run", "nowhere.toml", "--out", ""], "an empty path"),
    (["run", "nowhere.toml", "--out", "/dev/full"], "argument --out: '/dev/full'; allowed: a file"),
    (["rank", ""], "an empty path"),
    (["rank", "FILE", "--out", "FILE"], "trial.h5' is a file; allowed: a folder\n"),
    (["run", "nowhere.toml", "--out", "LINK"], "a.h5'; allowed: a file"),
    (["rank", "FILE", "--out", "/dev/full/x"], "/dev/full/x is or lies"),
    (["rank", "FILE", "--out", "/proc/x"], "/proc/x cannot be written: "),
    (["report", "FILE", "--out", "/proc/a.html"], "/proc/a.html cannot be written: "),
    (["materials", "plot", "cheetah", "--out", "/proc/a.png"], "/proc/a.png cannot be written: "),
    (["rank", "/proc"], "/proc cannot be read: "),
]


@pytest.mark.parametrize(("arguments", "expected"), REFUSED)
def test_refusals_take_two_lines_and_exit_with_2(capsys, file, tmp_path, arguments, expected):
    link = tmp_path / "a.h5"
    link.symlink_to("/dev/null")
    words = [word.replace("FILE", file).replace("LINK", str(link)) for word in arguments]
    status, out, err = crumple(capsys, *words)
    assert (status, out) == (2, "")
    assert expected in err
    assert err.count("\n") <= 2


@pytest.mark.parametrize("columns", [60, 200])
def test_help_fits_the_terminal(capsys, monkeypatch, columns):
    """But for lines that are indented, such as examples."""
    monkeypatch.setenv("COLUMNS", str(columns))
    for verb in VERBS:
        _, shown, _ = crumple(capsys, verb, "--help")
        prose = [line for line in shown.splitlines() if not line.startswith((" ", "usage:"))]
        assert max(map(len, prose)) <= min(columns, 100), verb


def test_disk_that_is_full_is_told_in_a_line(tmp_path):
    """Also where h5py finds it, which says more."""
    long = "Can't synchronously write data (file write failed: time = ...\n, errno = 28)"
    with pytest.raises(ArgumentError) as refused, writing(tmp_path, Path("a.vtkhdf")):
        raise OSError(errno.ENOSPC, long)
    assert str(refused.value) == "a.vtkhdf cannot be written: No space left on device"


def test_pictures_need_a_folder(capsys, file):
    for folder, why in {f"{file}/x": "allowed: a folder", "/proc/x": "cannot be written"}.items():
        status, _, err = crumple(capsys, "show", file, f"{1:016x}", "--out", folder)
        assert (status, err.count("\n")) == (2, 1)
        assert err.startswith(f"crumple show: {folder} ")
        assert why in err


def test_a_brief_ranking_is_tables_and_warnings(capsys, file):
    _, whole, _ = crumple(capsys, "rank", file)
    _, brief, _ = crumple(capsys, "rank", file, "--brief")
    assert whole.startswith(brief.split("\n\n")[0])
    assert "Pareto front" in whole
    assert "Pareto front" not in brief
    assert "2 of 5 cases failed" in brief


@pytest.mark.parametrize("there", [True, False])
def test_report_opens_the_page_in_the_browser(capsys, monkeypatch, file, tmp_path, there):
    addresses = []
    monkeypatch.setattr("webbrowser.open", lambda url: addresses.append(url) or there)
    page = tmp_path / "my page.html"
    _, _, err = crumple(capsys, "report", file, "--out", str(page), "--open")
    assert addresses == [page.as_uri()]
    assert ("no browser" in err) == (not there)


def test_ranking_counts_failures_aloud(capsys, file, tmp_path):
    status, out, _ = crumple(capsys, "rank", file, "--by", "specific_absorption_J_per_g")
    assert status == 1
    assert "Best first: most energy per gram." in out
    assert f"2 of 5 cases failed: crumple status {file} says why" in out
    table = out.partition("──\n")[2].splitlines()
    assert [line[:3] for line in table[:3]] == [" 1*", "2=*", "2=*"]
    file = write(tmp_path / "trial.h5", summary({"status": "stopped"}, {"status": "timed_out"}))
    status, out, _ = crumple(capsys, "rank", file)
    assert status == 1
    assert "No design is ranked here: all cases failed (2).\nUnfinished: case " in out
    assert out.endswith(f"\n\n2 of 2 cases failed: crumple status {file} says why\n")


def test_config_speaks_where_the_arguments_are_silent(capsys, tmp_path):
    config = {"rank": {"budgets": [0.5], "panel": [0.1, 0.05]}}
    file = write(tmp_path / "trial.h5", summary({}), {"config": json.dumps(config)})
    tiled = "tiled with separate specimens. At most"
    for words, told in (
        ([], f"Panel of 100 mm x 50 mm, {tiled} 500 g. Best"),
        (["--budget", "200 g"], f"Panel of 100 mm x 50 mm, {tiled} 200 g. Best"),
        (["--panel", "4 in", "2in"], f"Panel of 4 in x 2in, {tiled} 500 g. Best"),
        (["--budget", "2 oz"], "At most 2 oz. Best"),
        (["--budget", "2 oz", "2 oz"], "At most 2 oz. Best"),
        (["--by", "mass_g"], "Best first: least mass, in g."),
    ):
        assert told in crumple(capsys, "rank", file, *words)[1]


def test_requirements_of_the_config_hold_unless_an_option_replaces_or_drops_them(capsys, tmp_path):
    config = {
        "rank": {"budgets": [], "panel": [0.13, 0.05], "per": "panel"},
        "require": {"max_force": 800.0, "max_mass": None},
    }
    file = write(tmp_path / "trial.h5", summary({}), {"config": json.dumps(config)})
    for words, *told in (
        ([], "of a panel: force at most 800 N.", "force 1000 N, 25 % too much."),
        ([], f"to see the nearest: crumple show {file} 0000\nto print it: crumple export {file}"),
        (["--by", "mass_g"], "Nearest"),
        (["--max-force", "1 kN", "--max-mass", "60 g"], "at most 1000 N, mass at most 60 g"),
        (["--max-force", "1 kN", "--max-mass", "60 g"], "All designs (1) fulfil this."),
        (["--per", "specimen", "--max-force", "20 N"], "of a specimen: force at most 20 N."),
    ):
        _, out, _ = crumple(capsys, "rank", file, *words)
        assert [text for text in told if text not in out] == []
    assert "Required" not in crumple(capsys, "rank", file, "--max-force", "none")[1]


def test_force_of_a_panel_is_allowed_by_curves(capsys, tmp_path):
    """1200 N of 50 specimens: 24 N each, after 2 of 4 mm and 44 mJ."""
    file = write(tmp_path / "trial.h5", summary({"peak_force_N": 28.0}))
    panel = ["--panel", "130 mm", "50 mm", "--allowed-force", "1.2 kN", "--per", "panel"]
    _, out, _ = crumple(capsys, "rank", file, *panel, "--max-stroke", "3 mm")
    assert "force of a panel exceeds 1.2 kN" in out
    row = next(line for line in out.splitlines() if line.startswith("1*"))
    told = ["1*", "1.00", "134", "x", "50", "50.0", "2.20", "0.0440", "24.0", "1200", "2.00"]
    assert row.split() == told


def test_the_lightest_case_has_the_same_id_in_the_sentence_and_in_the_command(capsys, tmp_path):
    heavy, light = designs([2.0, 2.0], [0.1, 0.3]), designs([1.0, 1.0 - 1e-13], [0.1, 0.3])
    rows = [heavy[0], light[0] | {"platen": "contact"}, light[1] | {"platen": "sliding"}]
    file = write(
        tmp_path / "trial.h5", summary(*(r | {"case_id": f"{k}00"} for k, r in enumerate(rows)))
    )
    _, out, _ = crumple(capsys, "rank", file, "--budget", "0.5 g")
    assert " 1 g, case 100, ninjaflex." in out
    assert f"to see the lightest: crumple show {file} 100\n" in out


def test_csv_json_and_markdown_are_clean(capsys, file):
    status, text, errors = crumple(capsys, "rank", file, "--csv")
    assert errors == f"2 of 5 cases failed: crumple status {file} says why\n"
    table = pd.read_csv(io.StringIO(text), dtype={"case_id": str})
    assert status == 1
    assert list(table["case_id"]) == [f"{number:016x}" for number in (1, 0, 3, 4)]
    assert list(table["best_place"].dropna()) == [1, 1]  # of those that stopped
    records = json.loads(crumple(capsys, "rank", file, "--json")[1])
    assert [record["place"] for record in records] == [1, 2, None, None]
    table, notes = crumple(capsys, "rank", file, "--markdown")[1].split("\n\nUnfinished", 1)
    assert {line[0] for line in table.splitlines()[2:]} == {"|"}
    assert notes.count("Unfinished") == 1


def test_folder_holds_tables_and_figures(capsys, file, tmp_path):
    folder = tmp_path / "trial"
    drops = ["--drop-height", "0.5 m", "--drop-height", "50 cm"]
    _, out, _ = crumple(capsys, "rank", file, "--out", str(folder), *drops)
    pictures = ["absorption", "energy_absorption", "cushion_500mm", "winners"]
    names = ["ranking.md", "ranking.csv", *(f"{name}.png" for name in pictures)]
    assert out.split() == [str(folder / name) for name in names]
    assert all((folder / name).stat().st_size > 200 for name in names)
    assert pd.read_csv(folder / "ranking.csv")["place"].notna().sum() == 3


@pytest.mark.usefixtures("unpainted")
def test_heights_of_cushion_curves_may_be_those_of_the_config(capsys, tmp_path):
    about = {"config": json.dumps({"rank": {"drop_heights": [0.5]}})}
    load = {"loading_mode": "force", "force_N": 5.0, "peak_strain": 0.1}
    for row, words, heights in (
        ({}, [], ["500"]),
        ({}, ["--drop-height", "1 m"], ["1000"]),
        (load, [], []),
    ):
        file = write(tmp_path / "a.h5", summary(row), about)
        status, out, _ = crumple(capsys, "rank", file, "--out", str(tmp_path / "a"), *words)
        assert (status, re.findall(r"cushion_(\d+)mm", out)) == (0, heights)


def test_that_nothing_meets_what_is_asked_is_an_answer(capsys, tmp_path):
    file = write(tmp_path / "trial.h5", summary({}))
    status, out, _ = crumple(capsys, "rank", file, "--max-force", "1 N")
    assert status == 0
    assert "No design is ranked here." in out
    assert "Best first" not in out
    status, _, err = crumple(capsys, "show", file, "1", "--budget", "0.1 g")
    assert status == 2
    assert "lightest design: case 0000" in err


@pytest.mark.parametrize("words", [[], ["--dry-run"]])
def test_panel_below_half_a_specimen_is_refused_before_the_run(capsys, config, words):
    text = Path(config).read_text().replace("[rank]\n", '[rank]\npanel = ["5 mm", "50 mm"]\n')
    Path(config).write_text(text)
    status, _, err = crumple(capsys, "run", config, *words)
    assert status == 2
    assert err.startswith("crumple run: a panel of 5 mm is ")
    assert not Path("results").exists()


def test_results_that_are_complete_are_ranked_where_nothing_can_be_written(
    capsys, config, monkeypatch
):
    def refused(*_):
        raise PermissionError(13, "Permission denied")

    assert crumple(capsys, "run", config)[0] == 1
    monkeypatch.setattr("sweep.store.write.exclusive", refused)
    status, out, err = crumple(capsys, "run", config)
    assert (status, "Best first: " in out) == (1, True)
    assert "cannot be written: Permission denied. All 3 cases are in it already.\n" in err
    status, out, err = crumple(capsys, "run", config, "--retry-failed")
    assert (status, out) == (2, "")
    assert err == "crumple run: results/trial.h5 cannot be written: Permission denied.\n"


def test_status_gathers_failures_of_one_kind(capsys, file):
    status, out, _ = crumple(capsys, "status", file)
    assert status == 1
    for told in (
        "      3 converged\n      2 stopped\n",
        "2 x stopped at strain 0.41 to 0.5 in 4: smaller steps (case 0000000000000003, ",
        f", 0000000000000004)\ncrumple show {file} lists",
        *("10 s of processor time", "abc123", "numpy 9.9"),
    ):
        assert told in out
    status, out, err = crumple(capsys, "status", file, "--json")
    said = json.loads(out)
    assert (status, err) == (1, "")
    assert (said["cases"], said["converged"], said["failed"]) == (5, 3, 2)


def test_status_tells_how_many_cases_it_does_not_name(capsys, tmp_path):
    sentences = ["at -2e-3 of 9", "at 5 of 9", "at 10 of 9", "at 0.5 of 9", "lost"]
    rows = [{"status": "stopped", "message": text} for text in sentences]
    file = write(tmp_path / "trial.h5", summary(*rows))
    _, out, _ = crumple(capsys, "status", file)
    assert "4 x at -2e-3 to 10 of 9 (case 0000000000000000, 0000000000000001, " in out
    assert "000000000002 and 1 more)\n1 x lost (case 0000000000000004)\n" in out
    file = write(tmp_path / "done.h5", summary({}))
    assert "crumple show" not in crumple(capsys, "status", file)[1]


def test_show_draws_the_case_whose_id_begins_so(capsys, tmp_path):
    table = summary(
        {"case_id": "ab01"}, {"case_id": "ab02"}, {"case_id": "cd", "status": "stopped"}
    )
    file = write(tmp_path / "trial.h5", table)
    status, out, _ = crumple(capsys, "show", file, "ab02")
    pictures = [Path(line) for line in out.splitlines()[1:]]
    assert status == 0
    assert [path.name for path in pictures] == ["force.png", "energies.png", "shapes.png"]
    assert {path.parent for path in pictures} == {tmp_path / "trial" / "ab02"}
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in pictures)
    assert "nothing to draw" in crumple(capsys, "show", file, "cd")[1]


@pytest.mark.usefixtures("unpainted")
def test_show_tells_the_settings_of_the_slicer_and_what_does_not_print(capsys, tmp_path):
    settings = {"slicer_settings": "PrusaSlicer: stars, 20 %"}
    table = summary(settings, {"does_not_print": "walls of 1.5 lines of 0.4 mm"})
    file = write(tmp_path / "trial.h5", table)
    told = "printed by PrusaSlicer: stars, 20 %", "does not print: walls of 1.5 lines of 0.4 mm"
    for number, line in enumerate(told):
        assert crumple(capsys, "show", file, f"{number:016x}")[1].splitlines()[1] == line


def test_run_says_which_combinations_are_left_out(capsys, tmp_path):
    path = tmp_path / "trial.toml"
    path.write_text(
        "[lattice]\nprintable = true\n[loading]\nstrain = 0.1\n"
        '[grid]\nlattice.wall_thickness = ["0.4 mm", "0.5 mm", "0.6 mm"]'
    )
    status, _, err = crumple(capsys, "run", str(path), "--dry-run")
    assert status == 0
    assert "lattice.printable" in err
    assert "(2 of 3 combinations)" in err


def test_export_tells_what_it_wrote(capsys, tmp_path):
    file = write(tmp_path / "trial.h5", summary({"case_id": "ab01"}))
    for told in ("", ", replaced"):
        status, out, _ = crumple(capsys, "export", file, "ab", "--to", str(tmp_path / "c.csv"))
        assert (status, out) == (0, f"{tmp_path}/c.csv{told}\n")
    _, out, _ = crumple(capsys, "export", file, "ab", "--to", str(tmp_path / "crush.vtkhdf"))
    assert out == f"{tmp_path}/crush.vtkhdf\n"
    _, out, _ = crumple(capsys, "export", file, "1", "--to", str(tmp_path / "made/c.csv"))
    number, path = out.splitlines()
    assert number.startswith("number 1 of 1: ")
    assert path == f"{tmp_path}/made/c.csv, in a new folder"


@pytest.mark.parametrize(
    "words", [["--to", "new/a.step"], ["--to", "new/a.stl", "--panel", "1", "2"]]
)
def test_export_refuses_its_arguments_before_anything_is_told(capsys, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    file = write(tmp_path / "trial.h5", summary({"case_id": "ab01"}))
    status, out, err = crumple(capsys, "export", file, "1", *words)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert [path.name for path in tmp_path.iterdir()] == ["trial.h5"]


@pytest.mark.usefixtures("unpainted")
def test_show_takes_a_number_of_the_ranking_and_says_which_case_that_is(capsys, file):
    status, out, _ = crumple(capsys, "show", file, "1", "--budget", "1 g")
    first, second, *_ = out.splitlines()
    assert status == 0
    assert first.startswith("number 1 of 1: ")
    assert first.endswith(", up to 1 g")
    assert second.startswith(f"case {0:016x}, ")
    status, _, err = crumple(capsys, "show", file, f"{1:016x}", "--scene", "1")
    assert (status, err.split(": ")[1]) == (2, "--scene")


@pytest.mark.parametrize("mode", ["displacement", "impact"])
def test_what_an_allowed_force_is_for_is_told(capsys, tmp_path, mode):
    row = {absorbed_energy_column(50.0): 0.01, "loading_mode": mode}
    file = write(tmp_path / "trial.h5", summary(row))
    told = {"displacement": "part exceeds 0.05 kN", "impact": "0.05 kN has no effect"}[mode]
    assert told in crumple(capsys, "rank", file, "--allowed-force", "0.05 kN")[1]


QUESTIONS = [
    ["--panel", "100 mm", "50 mm"],
    ["--panel", "100 mm", "50 mm", "--per", "panel", "--allowed-force", "1 kN"],
    ["--budget", "2 g", "4 g", "--max-force", "25 N"],
    ["--by", "mass_g"],
    ["--min-absorbed", "0.25 J", "--max-mass", "3 g", "--max-stroke", "9 mm"],
]


@pytest.mark.usefixtures("unpainted")
@pytest.mark.parametrize(
    ("question", "number"), [*((question, 2) for question in QUESTIONS), (QUESTIONS[2], 1)]
)
def test_a_number_is_that_of_the_ranking_with_the_same_options(capsys, tmp_path, question, number):
    rows = designs([1.0, 2.0, 4.0], [0.1, 0.3, 0.4])
    for row, width, peak in zip(rows, [13e-3, 26e-3, 52e-3], [20.0, 22.0, 27.0], strict=True):
        row |= {"outer_width_m": width, "peak_force_N": peak}
    file = write(tmp_path / "trial.h5", summary(*rows))
    text = crumple(capsys, "rank", file, *question, "--csv")[1]
    ranking = pd.read_csv(io.StringIO(text), dtype={"case_id": str})
    if "budget_g" in ranking:
        first = ranking["budget_g"].iloc[0]
        ranking = ranking[ranking["budget_g"].isna() | (ranking["budget_g"] == first)]
    words = [file, str(number), *question]
    if number > len(ranking):
        assert f"no number {number} " in crumple(capsys, "show", *words)[2]
        return
    shown = crumple(capsys, "show", *words)[1]
    assert f"case {ranking['case_id'].iloc[number - 1]}, " in shown
    if "--panel" not in question:  # curves have none
        told = crumple(capsys, "export", *words, "--to", str(tmp_path / "a.csv"))[1]
        assert told.splitlines()[0] == shown.splitlines()[0]


def test_the_panel_of_an_exported_number_is_also_that_of_the_ranking(capsys, tmp_path, monkeypatch):
    """A panel has more of the narrow design, which is the second alone."""
    asked = []
    monkeypatch.setattr(
        "sweep.export.export.export_case", lambda *words: asked.append(words) or (["a.stl"], [])
    )
    rows = designs([1.0, 2.0], [0.2, 0.3])
    rows[1] |= {"outer_width_m": 50e-3}
    file = write(tmp_path / "trial.h5", summary(*rows))
    panel = ["--panel", "100 mm", "50 mm"]
    words = ["--to", str(tmp_path / "a.stl"), "--by", "absorbed_energy_J"]
    assert crumple(capsys, "export", file, "1", *words)[0] == 0
    assert crumple(capsys, "export", file, "1", *panel, *words[:2])[0] == 0
    assert crumple(capsys, "export", file, f"{1:016x}", *panel, *words[:2])[0] == 0
    assert [(each[2], each[3]) for each in asked] == [
        (f"{1:016x}", None),
        (f"{0:016x}", panel[1:]),
        (f"{1:016x}", panel[1:]),
    ]
    status, _, err = crumple(capsys, "export", file, f"{1:016x}", "--per", "panel", *words[:2])
    assert (status, err.split(": ")[1]) == (2, "--per")


def test_show_without_a_case_lists_what_makes_them_differ(capsys, tmp_path):
    file = write(tmp_path / "trial.h5", summary({"cells_x": 2}, {"platen": "contact"}))
    _, out, _ = crumple(capsys, "show", file)
    rows = [line.split() for line in out.splitlines() if line.startswith("0")]
    assert [row[1:4] for row in rows] == [["2", "x", "3"], ["3", "x", "3"]]
    assert "contact platens" in out


def test_run_simulates_ranks_and_tells_of_failures(capsys, config):
    status, out, err = crumple(capsys, "run", config)
    assert status == 1
    assert "3/3 cases" not in out
    assert "3/3 cases" in err
    place, show, rank = err.splitlines()[-3:]
    assert place == "results: results/trial.h5"
    assert "crumple show results/trial.h5 1: " in show
    assert "crumple rank results/trial.h5 --out results/trial: " in rank
    assert "1 of 3 cases failed: crumple status results/trial.h5 " in out
    assert "No design weighs 5 g or less; " in out
    assert list(read_summary("results/trial.h5")["status"]) == ["converged", "stopped", "converged"]


def test_dry_run_counts_and_writes_nothing(capsys, config, tmp_path):
    status, out, _ = crumple(capsys, "run", config, "--dry-run")
    assert status == 0
    assert "3 different cases, 0 of them finished" in out
    assert "estimate" in out
    assert [path.name for path in tmp_path.iterdir()] == ["trial.toml"]
    crumple(capsys, "run", config)
    assert "nothing is left to run" in crumple(capsys, "run", config, "--dry-run")[1]
    assert (
        "estimate for 1 case," in crumple(capsys, "run", config, "--dry-run", "--retry-failed")[1]
    )


def test_example_runs_by_its_name_where_no_file_has_it(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    _, out, err = crumple(capsys, "run", "smoke", "--dry-run")
    (place, *_), (count, *_) = err.splitlines(), out.splitlines()
    assert re.fullmatch(r"example smoke: /.*/configs/smoke\.toml \(copy it to change it\)", place)
    assert count.startswith("smoke: 6 combinations")
    (tmp_path / "smoke").write_text('name = "mine"\n')
    assert crumple(capsys, "run", "smoke", "--dry-run")[1].startswith("mine: 1 combination")


def test_error_bars_run_companions_in_a_file_of_their_own(capsys, config):
    _, out, _ = crumple(capsys, "run", config, "--error-bars", "--dry-run")
    assert "error bars: 6 companions, 0 of them" in out
    assert "estimate for 9 cases" in out
    status, out, err = crumple(capsys, "run", config, "--error-bars")
    assert status == 1
    assert "2 designs: 4 companions, in results/trial.companions.h5" in err
    assert "1 of 3 cases failed: " in out
    assert "±: estimated error" in out
    _, out, _ = crumple(capsys, "status", "results/trial.h5")
    assert out.startswith("results/trial.h5: 3 cases")
    assert "2 of 2 finished cases have error bars\n" in out
    assert len(read_summary("results/trial.companions.h5")) == 4


def test_spread_runs_the_best_designs_in_a_file_of_their_own(capsys, config):
    assert "known only after" in crumple(capsys, "run", config, "--spread", "--dry-run")[1]
    status, out, err = crumple(capsys, "run", config, "--spread")
    assert status == 1
    corners = read_summary("results/trial.spread.h5")
    assert f"spread of 2 designs: {len(corners)} cases, in results/trial.spread.h5" in err
    assert {"contact.friction", "material.modulus", "material.poisson"} < set(corners)
    assert "Spread of " in out
    assert len(read_summary("results/trial.h5")) == 3
    assert "cases, in" not in crumple(capsys, "run", config, "--spread")[2]


MIXED = """
name = "mixed"
[lattice]
cells = 2
nodes_per_wall = 1
depth = "12 mm"
width = "12 mm"
height = "12 mm"
[loading]
mode = "displacement"
strain = 0.02
unload = false
[solver]
load_steps = 2
[grid]
"lattice.wall_thickness" = ["1 mm", "1.2 mm"]
"loading.direction" = ["in_plane", "out_of_plane"]
"""


def test_screen_runs_cells_first_and_only_the_best_as_a_whole(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("mixed.toml").write_text(MIXED)
    words = ["run", "mixed.toml", "--screen", "1"]
    assert "--screen runs one cell" in crumple(capsys, *words, "--dry-run")[1]
    status, out, err = crumple(capsys, *words)
    assert status == 0
    assert "2 designs: 2 unit columns, in results/mixed.screen.h5" in err
    assert "Estimates of " in out
    assert "1 of 2 designs ran as a whole: " in out
    found = read_summary("results/mixed.h5")
    assert sorted(found["direction"]) == ["in_plane", "in_plane", "out_of_plane"]
    assert set(read_summary("results/mixed.screen.h5")["cells_x"]) == {1}
    status, again, err = crumple(capsys, *words)
    assert (status, again) == (0, out)
    assert "screen of" not in err
    assert "2 of 2 designs ran" in crumple(capsys, *words[:-1], "2")[1]
    assert len(read_summary("results/mixed.h5")) == 4


def test_screen_of_crushes_across_the_cells_is_refused(capsys, config):
    status, _, err = crumple(capsys, "run", config, "--screen", "2")
    assert status == 2
    assert "no case of this config" in err
    assert not Path("results/trial.h5").exists()


@pytest.mark.parametrize(
    ("stop", "told"),
    [(KeyboardInterrupt(), "interrupted\n"), (Interrupted("it keeps 3 of 4"), "it keeps 3 of 4\n")],
)
def test_interruption_says_what_is_kept(capsys, config, monkeypatch, stop, told):
    def interrupt(*_):
        raise stop

    monkeypatch.setattr("sweep.cli.run.run_sweep", interrupt)
    assert crumple(capsys, "run", config) == (1, "", told)


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["--worker", "1"], "--worker 1; the nearest is --workers"),
        (["-o", "f.h5"], "-o f.h5; the nearest is --out"),
        (["--outt=f.h5"], "--outt=f.h5; the nearest is --out"),
        (["-s"], "-s; the nearest is --scheduler or --spread or --screen"),
        (["f.h5"], "f.h5"),
        (["-x"], "-x"),
    ],
)
def test_what_a_verb_does_not_take_is_told_with_the_nearest(capsys, config, words, hint):
    status, out, err = crumple(capsys, "run", config, *words)
    assert (status, out) == (2, "")
    assert err == (
        f"crumple run: unrecognized arguments: {hint}\ncrumple run --help shows examples\n"
    )


@pytest.mark.parametrize(
    ("verb", "words"),
    [
        ("rank", ["--max-mass", "20 g", "--max-mass=3 g"]),
        ("rank", ["--panel", "9 mm", "9 mm", "--panel", "8 mm", "8 mm"]),
        ("run", ["--workers", "1", "--workers", "1"]),
        ("optimize", ["--seed", "1", "--seed", "2"]),
    ],
)
def test_an_option_is_given_once(capsys, verb, words):
    status, out, err = crumple(capsys, verb, "none.h5", *words)
    assert (status, out) == (2, "")
    assert err.startswith(f"crumple {verb}: argument {words[0]}: given twice; allowed: once\n")


def test_a_list_of_budgets_may_go_on():
    words = "rank trial.h5 --budget 9g 8g --budget 7g"
    assert parser().parse_args(words.split()).budget == ["9g", "8g", "7g"]


def test_help_without_examples_promises_none(capsys):
    for verb, shown in (("status", "what it takes"), ("rank", "examples")):
        assert crumple(capsys, verb)[2].endswith(f"crumple {verb} --help shows {shown}\n")


def test_what_a_profile_gave_is_told_before_the_faults(capsys, tmp_path):
    settings = "fill_pattern = grid\nfill_density = 20%\nlayer_height = 0.2\nperimeters = 2"
    (tmp_path / "own.ini").write_text(f"# generated by PrusaSlicer 2.7\n{settings}\n")
    config = tmp_path / "own.toml"
    config.write_text('[lattice]\nprofile = "own.ini"\nwidht = "9 mm"\n')
    status, _, err = crumple(capsys, "run", str(config), "--dry-run")
    profile, fault = (err.index(text) for text in ("own.ini, of PrusaSlicer: ", "lattice.widht"))
    assert (status, profile < fault) == (2, True)


@pytest.mark.parametrize("words", [["status"], ["rank"], ["show"], ["rank", "--csv"]])
def test_a_damaged_file_or_config_is_refused_in_one_line(capsys, tmp_path, words):
    file = Path(write(tmp_path / "trial.h5", summary({}), {"config": "{"}))
    if words == ["rank"]:
        assert f"{file} is damaged: " in crumple(capsys, "rank", str(file))[2]
    file.write_bytes(file.read_bytes()[:-1000])
    status, out, err = crumple(capsys, words[0], str(file), *words[1:])
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(f"crumple {words[0]}: {file} is damaged: move it away")
