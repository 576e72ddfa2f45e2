"""A results file that is copied alone: its cases are ranked, shown, exported and run again from it.

The config, the file of its structure and the file of its material are deleted.
"""

import shutil

import pandas as pd
import pytest

import crumple
from sweep.config.materials.material_file import FOLDER as MATERIALS
from sweep.config.reading.examples import FOLDER
from tests.support.command import crumple as command

MATERIAL = """
[material]
name = "mine.csv"
"""
CONFIGS = {
    "custom": """
name = "custom"
[lattice]
kind = "custom"
file = "custom.json"
[solver]
integrator = "static"
load_steps = 20
""",
    "cells": """
name = "cells"
[grid]
"lattice.kind" = ["square", "hex"]
[lattice]
infill = "20 %"
[loading]
strain = 0.02
[solver]
load_steps = 4
[rank]
budgets = ["50 g"]
""",
    "sliced": """
name = "sliced"
[lattice]
slicer = "prusa"
pattern = "grid"
mass = "3 g"
width = "25 mm"
[loading]
strain = 0.02
[solver]
load_steps = 3
""",
    "along": """
name = "along"
[lattice]
cells = 1
nodes_per_wall = 1
layers = 3
[loading]
direction = "out_of_plane"
strain = 0.01
[solver]
load_steps = 2
""",
}
SHARES = {"cpu_s": 0.0, "git_revision": ""}  # columns that differ from run to run


@pytest.fixture(params=CONFIGS)
def file(request, tmp_path, monkeypatch, capsys):
    """The results of a config of each kind, alone in a folder."""
    home, away = tmp_path / "home", tmp_path / "away"
    home.mkdir()
    away.mkdir()
    shutil.copy(FOLDER / "custom.json", home)
    shutil.copy(MATERIALS / "ninjaflex.csv", home / "mine.csv")
    (home / "trial.toml").write_text(CONFIGS[request.param] + MATERIAL)
    monkeypatch.chdir(home)
    status, said, wrong = command(capsys, "run", "trial.toml", "--out", "trial.h5")
    assert status == 0, said + wrong
    shutil.copy("trial.h5", away)
    monkeypatch.chdir(away)
    shutil.rmtree(home)
    return "trial.h5"


@pytest.mark.usefixtures("unpainted")
def test_everything_follows_from_the_file(file, capsys, tmp_path):
    results = crumple.Results(file)
    case_id = results.table["case_id"].iloc[-1]
    assert command(capsys, "show", file, case_id, "--out", case_id)[0] == 0
    for ending in (".stl", ".3mf", ".svg", ".dxf", ".csv", ".vtkhdf"):
        status, said, _ = command(capsys, "export", file, case_id, "--to", f"a{ending}")
        assert status == 0, said
    for number in range(len(results.table)):
        assert_same(results, number)
    for verb in ("status", "verify", "rank", "report"):
        assert command(capsys, verb, file)[0] == 0, verb
    assert (tmp_path / "away" / "trial.html").stat().st_size > 10_000


def assert_same(results, number):
    """The case of a row gives the row and its curves again."""
    case, row = results.case(number), results.table.iloc[number]
    again = crumple.simulate(case)
    assert again.case_id == row["case_id"]
    for name, value in (again.summary | SHARES).items():
        if name not in SHARES:
            assert value == row[name] or (value != value and row[name] != row[name]), name
    curve = pd.DataFrame(again.history).astype("float32").astype(float)
    pd.testing.assert_frame_equal(results.curve(number), curve)
