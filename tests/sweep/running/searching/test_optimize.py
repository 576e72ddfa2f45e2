"""A search from Python: its results, their file, refusals."""

import tomllib
from importlib import import_module

import pytest

from sweep.config.load import load_config
from sweep.ranking.question import RankError
from sweep.running.searching.optimize import OptimizeError, optimize
from tests.support.results.searches import BEST, TOML, simulate

ENERGY = "absorbed_energy_J"
PERIODS = {
    "loading": {"mode": "force", "force": "5 N", "platen": "glued"},
    "lattice": {"kind": "square", "sides": "periodic", "cells_y": 2},
    "search": {
        "lattice.width": ["6 mm", "12 mm"],
        "lattice.wall_thickness": {"from": "0.4 mm", "to": "0.8 mm"},
    },
}
MIXED = PERIODS | {
    "lattice": {"kind": "square", "cells": 2},
    "search": {
        "lattice.sides": ["periodic", "free"],
        "lattice.wall_thickness": {"from": "0.4 mm", "to": "0.8 mm"},
    },
}


@pytest.fixture
def tables(tmp_path, monkeypatch):
    """A search on invented results, as a dict."""
    monkeypatch.setattr(import_module("sweep.simulation.retries"), "simulate", simulate)
    monkeypatch.chdir(tmp_path)
    return tomllib.loads(TOML)


def test_the_designs_that_were_tried_and_the_best_are_returned(tables, tmp_path):
    results = optimize(tables, by=ENERGY, evaluations=18)
    best = results.rank(top=1)
    assert len(results) == 18
    assert results.path.name == "sought.h5"
    assert best["lattice_kind"].item() == BEST[0]
    assert best[ENERGY].item() == results.table[ENERGY].max()


def test_two_numbers_that_may_be_meant_as_a_range_are_told(tables, capsys):
    tables["search"]["lattice.printable"] = [True, False]
    optimize(tables, by=ENERGY, evaluations=4)
    assert "only" not in capsys.readouterr().err
    key = "lattice.wall_thickness"
    tables["search"][key] = ["1.2 mm", "0.4 mm"]
    optimize(tables, by=ENERGY, evaluations=4, out="two.h5")
    told = f'[search] {key}: only "0.4 mm" and "1.2 mm"; for all between them: '
    assert told + '{from = "0.4 mm", to = "1.2 mm"}' in capsys.readouterr().err


def test_it_goes_on_where_it_ended_and_another_seed_does_not(tables):
    config = load_config(tables)
    first = optimize(config, by=ENERGY, evaluations=8)
    more = optimize(config, by=ENERGY, evaluations=12)
    assert list(more.table["case_id"])[:8] == list(first.table["case_id"])
    other = optimize(config, by=ENERGY, evaluations=8, seed=2)
    assert {*other.table["case_id"]}.isdisjoint(first.table["case_id"])


def test_what_is_asked_is_what_the_ranking_answers(tables):
    tables["require"] = {"max_stroke": "1 m"}
    asked = {"budget": "20 g", "allowed_force": "60 N", "require": {"max_mass": "0.7 g"}}
    results = optimize(tables, evaluations=8, **asked)
    assert "absorbed_energy_at_60N_J" in results.table
    assert set(results.question.require) == {"max_stroke", "max_mass"}
    assert results.rank(require=None)["mass_g"].max() <= 0.7  # the search kept to it
    assert results.rank()["ranked_by"].unique().tolist() == ["absorbed_energy_at_60N_J"]


@pytest.mark.parametrize(
    ("changed", "asked", "error", "told"),
    [
        ({"search": {}}, {}, OptimizeError, r"sought has no \[search\]"),
        ({}, {"budget": 25}, RankError, "a bare number"),
        ({}, {"require": {"max_mass": 1}}, RankError, "a bare number"),
        ({}, {"require": {"max_weight": "1 g"}}, RankError, "max_weight = .1 g.: unknown req"),
        ({}, {"evaluations": 0}, OptimizeError, "evaluations = 0; allowed: 1 or more"),
        (PERIODS, {}, OptimizeError, "periods of one area alone"),
        (MIXED, {}, OptimizeError, "periods of one area alone"),
    ],
)
def test_what_cannot_be_sought_is_refused(tables, changed, asked, error, told):
    """Other refusals: `tests/sweep/cli/test_optimize.py`."""
    with pytest.raises(error, match=told):
        optimize(tables | changed, **asked)
