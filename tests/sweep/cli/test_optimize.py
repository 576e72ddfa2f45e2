"""The verb `optimize`: its output, its files, its refusals."""

import shlex
from importlib import import_module

import pytest

from sweep.running.beside.run_beside import file_beside
from sweep.store.read import read_summary
from tests.support.command import crumple
from tests.support.results.searches import TOML, simulate

ENERGY = "absorbed_energy_J"
STRUCK = 'energy = "1 J"\nstriker_mass = "50 g"\nbase = "ribs"\nbase_span = "8 mm"'


SHEET = '[lattice]\nkind = "gyroid"\n[loading]\nmode = "displacement"\n[search]\n"lattice.'


@pytest.fixture
def config(tmp_path, monkeypatch):
    """A search on invented results."""
    monkeypatch.setattr(import_module("sweep.simulation.retries"), "simulate", simulate)
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "sought.toml"
    path.write_text(TOML)
    return path


def test_it_tells_the_best_with_their_spread_and_the_next_command(capsys, config):
    """Rows of another loading in the file are left alone."""
    words = [str(config), "--by", ENERGY, "--pareto", "mass_g", "--evaluations"]
    config.write_text(TOML.replace("0.6", "0.5"))
    assert crumple(capsys, "optimize", *words, "8")[0] == 0
    config.write_text(TOML)
    status, out, err = crumple(capsys, "optimize", *words, "24")
    assert status == 0
    assert "24 of at most 24 designs: the most absorbed energy is 0.992 J" in out + err
    assert out.count(f"Best designs, simulated again: {ENERGY}") == 1
    assert f"Pareto front of {ENERGY} and mass_g" in out
    assert "Excluded: " in out
    assert len(read_summary("results/sought.h5")) == 32
    assert len(read_summary(file_beside("results/sought.h5", "spread"))) >= 15
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
    assert "absorbed_energy_at_60N_J" in read_summary("results/sought.h5")
    assert "8/8 cases" not in crumple(capsys, "optimize", *words)[1]  # nothing is computed twice
    struck = TOML.replace('mode = "displacement"\nstrain = 0.6', STRUCK)
    config.write_text(struck)
    out = crumple(capsys, "optimize", *words[:3], *words[5:])[1]
    assert out.endswith("results/sought.h5 --max-force '0.06 kN'\n")


def test_budget_that_no_design_keeps(capsys, config, tmp_path, monkeypatch):
    for module in ("search", "optimize"):
        monkeypatch.setattr(f"sweep.running.searching.{module}.MOST_TRIED", 64)
    status, _, err = crumple(capsys, "optimize", str(config), "--budget", "0.01 g")
    assert (status, err.count("\n")) == (2, 1)
    assert all(part in err for part in ("64 points", "at most 0.01 g; allowed: more mass"))
    assert [path.name for path in tmp_path.iterdir()] == ["sought.toml"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ([], "2 budgets; needed: one"),
        (["--budget", "25"], "a bare number"),
        (["--budget", "25 mm"], "another kind"),
        (["--budget", "-1 g"], "must be above zero"),
        (["--budget", "1 g", "--max-force", "60"], "a bare number"),
        (["--budget", "1 g", "--by", "cells_x"], '"cells_x" is no column'),
        (["--budget", "1 g", "--pareto", "weight"], '"weight" is no column'),
        (["--budget", "1 g", "--per", "panel"], "needed: a panel"),
        (["--budget", "1 g", "--max-deceleration", "9 g0"], "not known of a crush; needed: an im"),
        (["--budget", "1 g", "--min-absorbed", "9"], "a bare number"),
        (["--budget", "1 g", "--max-force", "9 N", "--allowed-force", "9 N"], "allowed: one of"),
        (["--evaluations", "0"], "1 or more"),
        (["--seed", "-1"], "1 or more"),
    ],
)
def test_refusals_write_nothing(capsys, config, tmp_path, words, told):
    config.write_text(f'{TOML}[rank]\nbudgets = ["5 g", "25 g"]\n')
    status, out, err = crumple(capsys, "optimize", str(config), *words)
    assert (status, out) == (2, "")
    assert told in err
    assert err.count("\n") <= 2
    assert [path.name for path in tmp_path.iterdir()] == ["sought.toml"]


def test_a_requirement_of_which_no_design_has_a_value_is_refused(capsys, config):
    config.write_text(TOML.replace('mode = "displacement"\nstrain = 0.6', STRUCK))
    for words in (["--max-base-pressure", "9 kPa"], ["--max-target-acceleration", "9 g0"]):
        status, _, err = crumple(capsys, "optimize", str(config), *words)
        assert (status, "not known of" in err) == (2, True)


def test_requirements_are_those_of_the_config_or_of_options(capsys, config):
    config.write_text(f'{TOML}\n[require]\nmin_absorbed = "0.5 J"\n')
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
    for told in (
        *("Nearest: case ", "Nearest to what is required"),
        "0 of 16 designs fulfil this; 16 fail: min_absorbed (16).",
        "to print the nearest: crumple export results/sought.h5 ",
    ):
        assert told in " ".join(out.split())
    assert "Pareto" not in out


def test_force_of_the_panel_is_looked_up_in_the_curves(capsys, config):
    panel = ["--panel", "100 mm", "50 mm", "--per", "panel"]
    words = [str(config), *panel, "--max-force", "5 kN", "--evaluations", "16"]
    status, out, err = crumple(capsys, "optimize", *words)
    assert (status, "none can be ranked" in err) == (0, False)
    assert "--allowed-force '5 kN' --per panel" in out
    assert "absorbed_energy_at_5000N_J" not in read_summary("results/sought.h5")


@pytest.mark.parametrize(
    ("text", "status", "told"),
    [
        (
            TOML.replace('["square", "hex", "diamond"]', '["brick"]'),
            1,
            "None of 8 designs can be ranked (8 failed: crumple status results/sought.h5 says",
        ),
        (f'{SHEET}cell_size" = ["5 mm", "7 mm"]', 2, "gyroid in [search]; allowed: lattices that"),
        (f'{SHEET}wall_thickness" = ["0.3 mm", "0.6 mm"]', 2, "gyroid in [search]; allowed: latt"),
        ("[grid]\nlattice.cells = [2, 3]", 2, "has no [search] "),
    ],
)
def test_a_search_that_ranks_nothing(capsys, config, text, status, told):
    config.write_text(text)
    found, out, err = crumple(capsys, "optimize", str(config), "--evaluations", "8")
    assert (found, told in out + err) == (status, True)


def test_a_config_of_a_search_does_not_run(capsys, config):
    status, _, err = crumple(capsys, "run", str(config))
    assert (status, "only `crumple optimize` searches" in err) == (2, True)
