"""A sweep from Python: its cases, and its results."""

import tomllib
from contextlib import nullcontext
from pathlib import Path

import dask
import pytest

from sweep.config.load import load_config
from sweep.ranking.question import RankError
from sweep.ranking.rank import ranked
from sweep.results import Results
from sweep.running.beside.run_beside import file_beside
from sweep.running.beside.spread import FRICTION
from sweep.running.run import run, spread
from sweep.store.read import read_summary


def test_results_are_those_of_the_config(config):
    first = run(config)
    assert (len(first), len(first.failed)) == (3, 1)
    assert first.path == Path("results/trial.h5")
    assert len(first.curve(0)) > 0
    assert (first.question.budget, first.question.panel) == ([0.005, 0.02], None)
    text = Path(config).read_text().replace("0.007, ", "")
    Path(config).write_text(text)
    fewer = run(load_config(config))
    assert list(fewer.table["case_id"]) == list(first.table["case_id"].iloc[[0, 2]])
    assert fewer.path == first.path


def test_pictures_require_what_the_config_requires(config):
    with Path(config).open("a") as file:
        file.write('\n[require]\nmax_mass = "1 mg"\n')
    table = ranked(run(config).table, **run(config).question._asdict()).table
    assert table.empty
    assert not ranked(run(config).table).table.empty


def test_a_panel_that_holds_no_specimen_is_refused_before_anything_runs(config):
    text = Path(config).read_text()
    Path(config).write_text(text.replace("[rank]\n", '[rank]\npanel = ["5 mm", "5 mm"]\n'))
    with pytest.raises(RankError, match="a panel of 5 mm is smaller than half of a specimen"):
        run(config)
    assert not Path("results").exists()


def test_where_cases_run(config, monkeypatch):
    """In the scheduler of the environment, unless threads are given."""
    places = []
    monkeypatch.setattr("sweep.running.run.run_sweep", lambda *how: places.append(how[3]))
    monkeypatch.setattr("sweep.running.run.open_place", nullcontext)
    with dask.config.set({"scheduler-address": "tcp://host:8786"}):
        run(config)
        run(config, workers=1)
    assert places == ["tcp://host:8786", None]


def test_error_bars_are_columns(config):
    assert "error_absorbed_energy_J" not in run(config).table
    table = run(config, error_bars=True).table
    assert (table["error_absorbed_energy_J"].notna() == (table["status"] == "converged")).all()


PRESSED = {"name": "pressed", "loading": {"mode": "displacement", "strain": 0.3}}
PRESSED |= {"grid": {"lattice.imperfection": [0.006, 0.008]}}


def test_the_best_are_run_again_at_the_ends_of_ranges(config):
    results = run(PRESSED)
    table = spread(results, top=1)
    beside = read_summary(file_beside(results.path, "spread"))
    best = results.rank(top=1)
    assert list(table["case_id"]) == list(best["case_id"])
    assert set(beside["contact.friction"].dropna()) == set(FRICTION)
    assert list(table["value"]) == list(best[table["ranked_by"].iloc[0]])
    assert (table["lowest"] <= table["value"]).all()
    assert (table["value"] <= table["highest"]).all()
    assert (table["failed"] == 0).all()
    assert spread(str(results.path), top=1).equals(spread(Results(results.path), top=1))


def test_a_dict_runs_as_its_file_does_and_the_results_may_be_named(config, tmp_path):
    of_dict = run(tomllib.loads(Path(config).read_text()), tmp_path / "own.h5", workers=1)
    assert (tmp_path / "own.h5").exists()
    assert not Path("results").exists()
    assert list(of_dict.table["case_id"]) == list(run(config).table["case_id"])


@pytest.mark.parametrize(
    ("loading", "require", "needed"),
    [
        ({"base": "ribs", "base_span": "9 mm"}, {"max_base_pressure": "1 kPa"}, "a flat base"),
        ({"platen": "contact"}, {"max_target_acceleration": "9 g0"}, "loading.target_mass"),
    ],
)
def test_a_requirement_of_which_no_case_has_a_value_is_refused(config, loading, require, needed):
    struck = {"mode": "impact", "striker_mass": "9 g", "striker_speed": "1 m/s"} | loading
    with pytest.raises(RankError, match=f"not known of these cases; needed: {needed}"):
        run({"loading": struck, "require": require})
    assert not Path("results").exists()
