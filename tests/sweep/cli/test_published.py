"""The verb `published`: the table, its repetition, and a user's own crush."""

import pytest

from sweep.published.table import OURS, read_table
from tests.support.command import crumple
from tests.support.readme import PAGES

CONFIG = """
lattice = {cells = 1, nodes_per_wall = 1}
loading = {strain = 0.02, unload = false, platen = "glued"}
solver.load_steps = 4
grid = {"material.modulus" = ["10 MPa", "20 MPa"]}
material = {density = "1200 kg/m^3"}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The current folder, with a config."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(CONFIG)
    return tmp_path


@pytest.mark.usefixtures("folder")
def test_the_table_has_all_rows_and_fits_a_terminal(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    status, out, err = crumple(capsys, "published")
    assert (status, err) == (0, "")
    lines = out.splitlines()
    assert max(map(len, lines)) <= 100
    for row in read_table(OURS):
        assert row.quantity in out
        assert row.source in out
    shown = "\n".join(line.rstrip() for line in out.strip("\n").splitlines())
    assert shown in PAGES["docs/published.md"]
    _, out, _ = crumple(capsys, "published", "ding")
    assert "2 of 2 inside" in out
    assert "ding plateau: ding_reentrant.toml: plateau_stress_Pa; 10 cases" in out
    assert "Khatri" not in out


def test_a_picture_and_the_table_are_written(capsys, folder):
    status, out, _ = crumple(capsys, "published", "--out", "found")
    assert status == 0
    assert out.endswith("found/published.md\nfound/published.png\n")
    assert (folder / "found/published.png").read_bytes().startswith(b"\x89PNG")
    assert "| Ding et al." in (folder / "found/published.md").read_text("utf-8")


def test_predictions_are_simulated_again(capsys, folder):
    status, out, _ = crumple(capsys, "published", "stiffness", "--run", "--workers", "1")
    assert status == 0
    assert "3 of 3 predictions as stored" in out
    assert (folder / "results/published/endless_stiffness.h5").exists()


def test_own_crush_is_predicted_before_its_value_is_entered(capsys, folder):
    words = ["published", "--add", "mine.toml", "--workers", "1"]
    status, out, _ = crumple(capsys, *words)
    (row,) = read_table(folder / "published.csv")
    assert status == 0
    assert row.name == "mine absorbed_energy_J"
    assert (row.quantity, row.open, row.measured) == ("absorbed energy, J", "modulus", "")
    assert float(row.high) == pytest.approx(2.0 * float(row.low), rel=1e-3)
    assert "1 waits for a value" in out
    value = f"{1500.0 * float(row.low):.4g} mJ"
    status, out, _ = crumple(capsys, *words, "--measured", value, "--source", "my press")
    (again,) = read_table(folder / "published.csv")
    assert status == 0
    assert (again.source, again.quantity) == ("my press", "absorbed energy, mJ")
    assert float(again.low) == pytest.approx(1000.0 * float(row.low), rel=1e-3)
    assert "18 of 21 inside" in out


def test_a_config_that_changes_after_the_value_is_told(capsys, folder):
    """The value may be a measured curve."""
    rows = [f"{0.02 * n},{5.0}" for n in range(20)]
    (folder / "curve.csv").write_text("\n".join(["displacement_mm,force_N", *rows]))
    words = ["published", "mine", "--add", "mine.toml", "--measured", "curve.csv"]
    words += ["--measure", "peak_force_N"]
    assert crumple(capsys, *words)[2].count("has changed since") == 0
    (row,) = read_table(folder / "published.csv")
    assert (row.measured, row.place) == ("5", "curve.csv")
    assert "  measured: 5, curve.csv\n" in crumple(capsys, "published", "mine")[1]
    (folder / "mine.toml").write_text(CONFIG.replace("20 MPa", "30 MPa"))
    assert crumple(capsys, *words)[2].count("has changed since") == 1


def test_a_prediction_that_does_not_come_out_again_is_told(capsys, folder):
    crumple(capsys, "published", "--add", "mine.toml")
    table = folder / "published.csv"
    (row,) = read_table(table)
    table.write_text(table.read_text("utf-8").replace(row.high, "9"), "utf-8")
    status, out, err = crumple(capsys, "published", "mine", "--run")
    assert status == 1
    assert "0 of 1 predictions as stored" in out
    assert f"stored {row.low} to 9" in err


def test_a_case_that_has_not_converged_is_told(capsys, folder):
    (folder / "mine.toml").write_text(
        CONFIG.replace("load_steps = 4", "load_steps = 20000")
        + 'solver.time_limit = "1e-9 s"\nsolver.retry = false\n'
    )
    status, _, err = crumple(capsys, "published", "--add", "mine.toml")
    assert status == 1
    assert "mine absorbed_energy_J: case " in err


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("words", "wrong"),
    [
        (["nobody"], "no row of nobody; allowed: words of square one row, "),
        (["--measured", "1 J"], "--measured belongs to --add"),
        (["--add", "none.toml"], "none.toml"),
        (["--add", "mine.toml", "--measured", "1 N"], "a unit of another kind"),
        (["--add", "mine.toml", "--measure", "energy"], "--measure energy; allowed: a column"),
        (["--add", "mine.toml", "--table", "a.txt"], "allowed: a file whose name ends in .csv"),
    ],
)
def test_refusals_say_what_is_allowed(capsys, words, wrong):
    status, _, err = crumple(capsys, "published", *words)
    assert status == 2
    assert wrong in err
