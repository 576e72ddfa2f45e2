"""The measured crush: its cases are as stated, and the values read from their results."""

from math import pi

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.running.sweep import run_sweep
from sweep.simulation.simulate import simulate
from tests.studies.course_report.cases import varied
from tests.studies.khatri_egan.across import (
    CONFIG,
    FACTORS,
    MEASURED,
    PLATENS,
    load_peaks,
    predictions,
    report,
)
from tests.support import readme

CASES = expand(load_config(CONFIG))


def changes(case):
    """The keys that differ from the first case, except platens and inertia."""
    base, apart = CASES[0].axes, {"loading.platen", "loading.quasi_static"} | {"solver.integrator"}
    return {key for key in base if case.axes[key] != base[key]} - apart


def coarse(case):
    rough = varied(case, lattice={"nodes_per_wall": 2}, solver={"load_steps": 120})
    return rough.model_copy(update={"axes": case.axes})


def test_cases_change_one_thing_each():
    speeds = [changes(case) for case in CASES if "loading.speed" in changes(case)]
    others = [changes(case) for case in CASES if "loading.speed" not in changes(case)]
    real = [{"loading.speed", key} for key in ("damping.relaxation_time", "material.loss")]
    assert all(change in real for change in speeds)
    assert sorted(map(len, others)) == 3 * [0] + (len(others) - 3) * [1]
    assert set().union(*others, *speeds) == FACTORS.keys() | {"loading.speed"}


def test_specimen_is_that_of_the_paper():
    lattice = CASES[0].lattice
    assert lattice.width / 3 - lattice.wall_thickness == pytest.approx(3.6e-3)
    assert lattice.outer_size == pytest.approx((12.4e-3, 12.4e-3))
    assert CASES[0].material.modulus == 67e6


def changed(case):
    """The changes of a case, in words."""
    keys = sorted(changes(case) & FACTORS.keys())
    return " ".join(f"{FACTORS[key].name} {FACTORS[key].text(case.axes[key])}" for key in keys)


def readme_rows():
    """Platens, changes ("": none) and the energy in J of the rows that the README shows."""
    for platens, *cells in readme.table("absorbed in J between platens"):
        for cell in cells:
            energy, _, words = cell.partition(": ")
            yield platens, words, float(energy)


@pytest.mark.parametrize(("platens", "words", "energy"), list(readme_rows()))
def test_experiment_holds_its_numbers(platens, words, energy):
    (platen,) = (key for key, (name, _) in PLATENS.items() if name == platens)
    (case,) = (c for c in CASES if c.loading.platen == platen and changed(c) == words)
    summary = simulate(case).summary
    assert summary["status"] == "converged"
    assert summary["max_crossings"] == 0
    assert summary["mass_g"] == pytest.approx(0.543, rel=1e-3)
    assert abs(summary["energy_residual_J"]) < 1e-6 * summary["absorbed_energy_J"]
    assert summary["absorbed_energy_J"] == pytest.approx(energy, rel=5e-3)


def test_results_become_a_table_and_two_pictures(tmp_path):
    keys = ({"contact.friction"}, {"material.plane"}, set())
    path = tmp_path / "khatri_egan_square.h5"
    assert run_sweep([coarse(case) for case in CASES if changes(case) in keys], path) == 0
    table = predictions(path)
    said = set(zip(table["factor"], table["value"], strict=True))
    assert said == {
        ("", ""),
        *(("friction", value) for value in ("0", "0.2", "0.9")),
        ("plane", "stress"),
    }
    text = report(path)
    assert (tmp_path / "experiment.md").read_text("utf-8") == text
    first = table["absorbed_energy_J"].iloc[0]
    assert (
        f"| loose               | base         | {first:.3f}       | {first / MEASURED:.2f} "
        in text
    )
    assert len(table) == 15
    assert (
        text.count("| stuck ") + text.count("| stuck, upper slides ") + text.count("| loose ") == 15
    )
    assert {file.name for file in tmp_path.glob("*.png")} == {
        "force_displacement.png",
        "tornado.png",
    }


def test_a_load_peak_is_followed_by_a_drop():
    travel = np.linspace(0.0, 3.0, 301)
    load = 10.0 + travel - np.cos(2.0 * pi * travel)
    assert load_peaks(load) == 3
    assert load_peaks(load[:250]) == 2  # up to the third peak
    assert load_peaks(load + 100.0) == 0  # drops by 2 %


@pytest.mark.parametrize(("platen", "buckles_at"), [("sliding", 1.0), ("glued", 4.0)])
def test_two_columns_buckle_at_eulers_load(platen, buckles_at):
    """One cell: both ends held against turning, the upper one free sideways or not.

    Beyond the load P of buckling the elastica bears P (1 + d / 2 l) when pressed by d.
    """
    side, thickness, strain = 10e-3, 0.2e-3, 0.01
    case = Case.of(
        lattice=dict(cells_x=1, cells_y=1, width=side, height=side, depth=10e-3,
                        wall_thickness=thickness, nodes_per_wall=35, imperfection=1e-3),
        material=dict(modulus=10e6, density=1200.0, plane="stress"),
        loading=dict(strain=strain, platen=platen, unload=False),
        contact=dict(model="none"),
        solver=dict(joints="points"),
    )  # fmt: skip
    result = simulate(case)
    second_moment = 10e-3 * thickness**3 / 12
    bears = 2.0 * buckles_at * pi**2 * 10e6 * second_moment / side**2 * (1.0 + 0.5 * strain)
    assert result.status == "converged"
    assert result.history["reaction_top_N"][-1] == pytest.approx(bears, rel=3e-3)
