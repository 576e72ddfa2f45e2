"""Accuracy studies: errors and orders of made-up and of real sweeps, and their answers."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.loading_modes import MODES
from sweep.ranking.accuracy import AccuracyError, energy, path, peak, studies
from sweep.report.tables.accuracy_tables import accuracy_sheets, setting
from sweep.running.sweep import run_sweep
from sweep.simulation.simulate import simulate
from sweep.store.read import read_summary
from tests.support import readme
from tests.support.command import crumple
from tests.support.results.made_up_studies import (
    ENERGY,
    ORDERS,
    PEAK,
    STEPS,
    all_steps,
    made_up,
    study,
)
from tests.support.results.specimens import there_and_back

CONFIGS = Path(__file__).parents[3] / "configs" / "accuracy"


def test_errors_are_those_against_the_limit_of_the_highest_order(tmp_path):
    (found,) = study(tmp_path, all_steps("backward_euler", "bdf2"))
    assert found.finest[["solver.integrator", "solver.time_step"]].tolist() == ["bdf2", 6.25e-5]
    assert found.references["energy"].value == pytest.approx(ENERGY, rel=1e-5)
    assert found.references["peak"].value == pytest.approx(PEAK, rel=1e-5)
    for name, share in (("energy", 1.0), ("peak", 1.0), ("path", 0.5 * np.sqrt(0.35))):
        off = [0.4 * (1e3 * step) ** p * share for p in (1, 2) for step in STEPS]
        np.testing.assert_allclose(found.settings[name], off, rtol=1e-3)
        for method, order in {"backward euler": 1, "bdf2": 2}.items():
            seen = found.orders[method][name]["solver.time_step"]
            assert seen == pytest.approx(order, abs=0.01)


def test_methods_of_one_order_that_disagree_are_doubted(tmp_path):
    rows = all_steps("bdf2", "newmark")
    for row in rows[len(STEPS) :]:
        row["peak_force_N"] += 0.1 * PEAK
    (found,) = study(tmp_path, rows)
    assert found.references["peak"].doubt == pytest.approx(1 / 11 - 0.4 / 256, rel=1e-2)
    assert found.references["energy"].doubt == pytest.approx(0.4 / 256, rel=1e-2)


def test_meshes_and_steps_are_extrapolated_together(tmp_path):
    rows = [
        made_up("bdf2", step) | {"lattice.nodes_per_wall": nodes}
        for step in STEPS
        for nodes in (1, 3, 7)
    ]
    for row in rows:
        row["absorbed_energy_J"] += 0.01 * ENERGY / (1 + row["lattice.nodes_per_wall"])
    (found,) = study(tmp_path, rows)
    assert found.references["energy"].value == pytest.approx(ENERGY, rel=1e-5)
    assert found.references["energy"].doubt == pytest.approx(0.4 / 256 + 0.01 / 8, rel=1e-2)
    assert found.orders["as set"]["energy"] == pytest.approx(
        {"solver.time_step": 2.0, "lattice.nodes_per_wall": 1.0}, abs=0.01
    )


def test_a_structure_is_measured_by_its_probes():
    history = there_and_back().iloc[:3].assign(
        probe_0_x_m=0.2, probe_1_x_m=[0.1, 0.2, 0.4], probe_1_rotation_rad=9.0,
        probe_0_reaction_x_N=[0.0, -3.0, 1.0], probe_0_reaction_y_N=[0.0, 4.0, 1.0],
    )  # fmt: skip
    row = pd.Series({"loading_mode": "custom"})
    _, (moves,) = path(MODES["custom"], history)
    np.testing.assert_allclose(moves, [0.0, 0.1, 0.3])
    assert peak(row, history) == 5.0
    left = history[["kinetic_J", "bend_J"]].iloc[-1].sum()
    assert energy(row, history) == pytest.approx(left)
    assert left > 0.0


def test_a_sweep_that_refines_nothing_is_refused(tmp_path, capsys, config):
    with pytest.raises(AccuracyError):
        study(tmp_path, [made_up("bdf2", 1e-3), made_up("newmark", 1e-3)])
    status, out, err = crumple(capsys, "accuracy", config, "--out", "there")
    assert (status, out) == (2, "")
    assert "[grid] refines nothing; allowed: two values or more of" in err
    assert not Path("there").exists()


def test_verb_prints_and_writes_the_study(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    text = (CONFIGS / "vibration.toml").read_text("utf-8").split("# From")[0]
    steps = '"solver.time_step" = ["1.25 ms", "0.625 ms", "0.3125 ms"]\n'
    (tmp_path / "vibration.toml").write_text(text + steps)
    (tmp_path / "vibration.json").write_bytes((CONFIGS / "vibration.json").read_bytes())
    folder = tmp_path / "study"
    words = ["accuracy", str(tmp_path / "vibration.toml"), "--out", str(folder)]
    status, out, _ = crumple(capsys, *words)
    assert status == 0
    assert max(map(len, out.splitlines()[:-3])) <= 100
    assert "cheapest setting below 1 % in energy left and motion of" in " ".join(out.split())
    assert {path.suffix for path in folder.iterdir()} == {".h5", ".md", ".csv", ".png"}
    assert len(pd.read_csv(folder / "vibration.csv")) == 9
    (found,) = studies(folder / "vibration.h5", read_summary(folder / "vibration.h5"))
    for integrator, order in ORDERS.items():
        seen = found.orders[integrator.replace("_", " ")]["path"]["solver.time_step"]
        assert seen == pytest.approx(order, abs=0.15)


# Of every study in the README the file, and which cases are enough for its rows.
TOLD = {
    "buckled": ("crush", {"loading.strain": 0.3, "solver.element": "cubic"}),
    "densified": ("crush", {"contact.friction": 0.0, "solver.element": "cubic"}),
    "force": ("force", {"solver.integrator": "bdf2", "solver.step_error": None}),
    "impact": ("impact", {"solver.integrator": "newmark"}),
    "vibration": ("vibration", {"solver.step_error": None}),
}


@pytest.mark.parametrize("name", TOLD)
def test_readme_tells_what_the_studies_find(name, tmp_path):
    (file, needed), path = TOLD[name], tmp_path / "study.h5"
    cases = expand(load_config(CONFIGS / f"{file}.toml"))
    run_sweep([case for case in cases if needed.items() <= case.axes.items()], path)
    (found,) = studies(path, read_summary(path))
    sheet, _ = accuracy_sheets(found, name)
    first = sheet.heads.index("energy %")
    words = [setting(found, row).removeprefix("as set, ") for _, row in found.settings.iterrows()]
    errors = {key: row[first : first + 3] for key, row in zip(words, sheet.rows, strict=True)}
    told = [row for row in readme.table("study") if row[0] == name]
    assert len(told) >= 2
    assert {row[0] for row in readme.table("study")} == TOLD.keys()
    for _, words, *texts, _ in told:
        (key,) = (key for key in errors if f", {words}".endswith(f", {key}"))
        said, shown = ["", *texts], ["", *errors[key]]
        assert readme.words(said) == readme.words(shown)
        said, shown = ([text for text in row if "<" not in text] for row in (said, shown))
        assert readme.numbers(said) == pytest.approx(readme.numbers(shown), rel=0.1)


# Of every study the axes of one case, and a number of it.
CUBIC, BDF2 = {"solver.element": "cubic"}, {"solver.integrator": "bdf2"}
PINNED = {
    "crush": (
        CUBIC | {"loading.strain": 0.3, "lattice.nodes_per_wall": 2, "solver.load_steps": 50},
        ("absorbed_energy_J", 0.09511),
    ),
    "force": (
        BDF2 | {"solver.time_step": 1e-3, "solver.step_error": None},
        ("absorbed_energy_J", 0.09913),
    ),
    "force_mesh": (
        {"lattice.nodes_per_wall": 1, "solver.time_step": 5e-4},
        ("absorbed_energy_J", 0.11029),
    ),
    "impact": (
        BDF2 | {"solver.time_step": 4e-5, "lattice.nodes_per_wall": 2},
        ("peak_force_N", 103.894),
    ),
    "vibration": (
        BDF2 | {"solver.time_step": 2e-2, "solver.step_error": None},
        ("dissipated_integrator_J", 1.1212e-7),
    ),
}


@pytest.mark.parametrize("name", [path.stem for path in CONFIGS.glob("*.toml")])
def test_studies_hold_their_numbers(name):
    axes, (column, number) = PINNED[name]
    cases = expand(load_config(CONFIGS / f"{name}.toml"))
    (case,) = (case for case in cases if axes.items() <= case.axes.items())
    summary = simulate(case).summary
    assert summary["status"] == "converged"
    assert summary[column] == pytest.approx(number, rel=1e-3)
