"""The verb `optimize`: its output, its files, its refusals."""

import shlex
from importlib import import_module

import pytest

from sweep.running.beside.run_beside import file_beside
from sweep.store.read import read_summary
from tests.support.command import crumple
from tests.support.results.searches import TOML, simulate

ENERGY = "absorbed_energy_J"


@pytest.fixture
def config(tmp_path, monkeypatch):
    """A search on invented results."""
    monkeypatch.setattr(import_module("sweep.simulation.retries"), "simulate", simulate)
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "sought.toml"
    path.write_text(TOML)
    return path


def test_it_tells_the_best_with_their_spread_and_the_next_command(capsys, config):
    words = [str(config), "--by", ENERGY, "--evaluations", "60", "--pareto", "mass_g"]
    status, out, err = crumple(capsys, "optimize", *words)
    assert status == 0
    assert "60 of at most 60 designs: the most absorbed energy is 1.00 J" in out + err
    assert f"Best designs, simulated again: {ENERGY}" in out
    assert f"Pareto front of {ENERGY} and mass_g" in out
    assert "Excluded: " in out
    assert len(read_summary("results/sought.h5")) == 60
    assert len(read_summary(file_beside("results/sought.h5", "spread"))) == 15
    *_, last = out.splitlines()
    told, _, command = last.partition("; to rank them: crumple ")
    assert told == "results: results/sought.h5"
    status, out, _ = crumple(capsys, *shlex.split(command))
    assert status == 0
    assert "Best first: most energy." in out


def test_budget_and_force_are_those_of_the_next_command(capsys, config):
    config.write_text(f'{TOML}[rank]\nbudgets = ["5 g", "25 g"]\npanel = ["10 cm", "5 cm"]\n')
    words = [str(config), "--evaluations", "8", "--budget", "20 g", "--max-force", "0.06 kN"]
    status, out, _ = crumple(capsys, "optimize", *words)
    assert status == 0
    assert out.endswith("results/sought.h5 --budget '20 g' --allowed-force '0.06 kN'\n")
    rows = read_summary("results/sought.h5")
    assert "absorbed_energy_at_60N_J" in rows
    status, out, _ = crumple(capsys, "optimize", *words)
    assert "8/8 cases" not in out  # nothing is computed twice


def test_a_search_whose_designs_all_fail(capsys, config):
    config.write_text(TOML.replace('["square", "hex", "diamond"]', '["brick"]'))
    status, out, _ = crumple(capsys, "optimize", str(config), "--evaluations", "8")
    assert status == 1
    assert "None of 8 designs can be ranked." in out


def test_budget_that_no_design_keeps(capsys, config, tmp_path, monkeypatch):
    for module in ("search", "optimize"):
        monkeypatch.setattr(f"sweep.running.searching.{module}.MOST_TRIED", 64)
    status, _, err = crumple(capsys, "optimize", str(config), "--budget", "0.01 g")
    assert (status, err.count("\n")) == (2, 1)
    assert all(part in err for part in ("64 points", "at most 0.01 g; allowed: more mass"))
    assert [path.name for path in tmp_path.iterdir()] == ["sought.toml"]


@pytest.mark.parametrize(
    "range_",
    ['cell_size" = ["5 mm", "7 mm"]', 'wall_thickness" = {from = "0.3 mm", to = "0.6 mm"}'],
)
def test_a_period_of_a_sheet_is_no_part(capsys, config, tmp_path, range_):
    path = tmp_path / "sheet.toml"
    sheet = '[lattice]\nkind = "gyroid"\n[loading]\nmode = "displacement"\n[search]\n'
    path.write_text(f'{sheet}"lattice.{range_}\n')
    status, out, err = crumple(capsys, "optimize", str(path), "--budget", "1 g")
    assert (status, out) == (2, "")
    assert "gyroid in [search]; allowed: lattices that are drawn with lines" in err


def test_rows_of_another_loading_are_left_alone(capsys, config):
    for strain in ("0.5", "0.6"):
        config.write_text(TOML.replace("0.6", strain))
        words = [str(config), "--by", ENERGY, "--evaluations", "16", "--pareto", "mass_g"]
        status, out, _ = crumple(capsys, "optimize", *words)
        assert status == 0
    assert len(read_summary("results/sought.h5")) == 32
    assert out.count("Best designs, simulated again") == 1


REFUSED = [
    ([], "2 budgets; needed: one"),
    (["--budget", "25"], "a bare number"),
    (["--budget", "25 mm"], "another kind"),
    (["--budget", "-1 g"], "must be above zero"),
    (["--budget", "1 g", "--max-force", "60"], "a bare number"),
    (["--budget", "1 g", "--by", "cells_x"], '"cells_x" is no column'),
    (["--budget", "1 g", "--pareto", "weight"], '"weight" is no column'),
    (["--budget", "1 g", "--per", "panel"], "needed: a panel"),
    (["--budget", "1 g", "--max-deceleration", "9 g0"], "not known of a crush; needed: an impact"),
    (["--budget", "1 g", "--min-absorbed", "9"], "a bare number"),
    (["--budget", "1 g", "--max-force", "9 N", "--allowed-force", "9 N"], "allowed: one of them"),
    (["--evaluations", "0"], "1 or more"),
    (["--seed", "-1"], "1 or more"),
]


@pytest.mark.parametrize(("words", "told"), REFUSED)
def test_refusals_write_nothing(capsys, config, tmp_path, words, told):
    config.write_text(f'{TOML}[rank]\nbudgets = ["5 g", "25 g"]\n')
    status, out, err = crumple(capsys, "optimize", str(config), *words)
    assert (status, out) == (2, "")
    assert told in err
    assert err.count("\n") <= 2
    assert [path.name for path in tmp_path.iterdir()] == ["sought.toml"]


def test_a_requirement_of_which_no_design_has_a_value_is_refused(capsys, config):
    struck = 'energy = "1 J"\nstriker_mass = "50 g"\nbase = "ribs"\nbase_span = "8 mm"'
    config.write_text(TOML.replace('mode = "displacement"\nstrain = 0.6', struck))
    for words in (["--max-base-pressure", "9 kPa"], ["--max-target-acceleration", "9 g0"]):
        status, _, err = crumple(capsys, "optimize", str(config), *words)
        assert (status, "not known of" in err) == (2, True)


def test_configs_are_for_one_verb(capsys, config, tmp_path):
    status, _, err = crumple(capsys, "run", str(config))
    assert status == 2
    assert "only `crumple optimize` searches" in err
    config.write_text("[grid]\nlattice.cells = [2, 3]")
    status, _, err = crumple(capsys, "optimize", str(config))
    assert (status, err.count("\n")) == (2, 1)
    assert "has no [search] " in err
    assert [path.name for path in tmp_path.iterdir()] == ["sought.toml"]


def test_requirements_are_those_of_the_config_or_of_options(capsys, config):
    text = config.read_text()
    config.write_text(f'{text}\n[require]\nmin_absorbed = "0.5 J"\n')
    words = [str(config), "--by", ENERGY, "--evaluations", "16"]
    status, out, _ = crumple(capsys, "optimize", *words, "--max-mass", "20 g")
    assert status == 0
    assert "Best designs, simulated again" in out
    assert "--min-absorbed" not in out  # rank finds it in the config
    assert "--max-mass '20 g'" in out
    command = shlex.split(out.splitlines()[-1].partition("; to rank them: crumple ")[2])
    _, told, _ = crumple(capsys, *command)
    assert "mass at most 20 g, usable energy at least 500 mJ." in told


def test_that_none_fulfils_is_told_with_the_nearest(capsys, config):
    words = [str(config), "--by", ENERGY, "--evaluations", "16", "--min-absorbed", "9 J"]
    status, out, err = crumple(capsys, "optimize", *words, "--pareto", "mass_g")
    assert status == 0
    assert "none fulfils all requirements; the nearest " in err
    assert "Nearest: case " in out
    assert "0 of 16 designs fulfil this; 16 fail: min_absorbed (16)." in out
    assert "Nearest to what is required" in out
    nearest = next(line.split() for line in out.splitlines() if line.startswith("to print"))
    assert nearest[:7] == [
        "to",
        "print",
        "the",
        "nearest:",
        "crumple",
        "export",
        "results/sought.h5",
    ]
    assert "Pareto" not in out


def test_force_of_the_panel_is_looked_up_in_the_curves(capsys, config):
    panel = ["--panel", "100 mm", "50 mm", "--per", "panel"]
    words = [str(config), *panel, "--max-force", "5 kN", "--evaluations", "16"]
    status, out, err = crumple(capsys, "optimize", *words)
    assert (status, "none can be ranked" in err) == (0, False)
    assert "--allowed-force '5 kN' --per panel" in out
    assert "absorbed_energy_at_5000N_J" not in read_summary("results/sought.h5")


def test_force_of_an_impact_is_required(capsys, config):
    text = config.read_text().replace(
        'mode = "displacement"\nstrain = 0.6', 'energy = "1 J"\nstriker_mass = "50 g"'
    )
    config.write_text(text)
    words = [str(config), "--max-force", "50 N", "--evaluations", "16"]
    _, out, _ = crumple(capsys, "optimize", *words)
    assert "--max-force '50 N'" in out
    assert "--allowed-force" not in out
