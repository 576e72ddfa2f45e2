"""The data of a page: values that rank designs, thin curves, shapes while there is room."""

import json
from pathlib import Path

import numpy as np
import pytest

from sweep.ranking.question import Question
from sweep.ranking.rank import ranked
from sweep.report.page import gather
from sweep.report.page.gather import curve_of, page_data
from sweep.report.page.selection import MOST
from sweep.simulation.up_to_force import absorbed_until
from tests.support.results.page_data import sweep
from tests.support.results.specimens import (
    HEIGHT,
    designs,
    squeezed_cell,
    summary,
    there_and_back,
    write,
)


def gathered(path, table, **question):
    return page_data(write(path / "trial.h5", table, {"config": "{}"}), table, Question(**question))


def test_commands_name_the_file_as_it_was_given(tmp_path, monkeypatch):
    """A page that is sent to others does not tell where its file was."""
    (tmp_path / "results").mkdir()
    monkeypatch.chdir(tmp_path)
    table = summary({})
    given = write(Path("results/trial.h5"), table, {"config": "{}"})
    for file, named in (given, "results/trial.h5"), (tmp_path / given, "trial.h5"):
        assert page_data(file, table, Question())["file"] == named


def test_page_has_every_case_once_in_the_scenes_of_the_terminal(tmp_path):
    crush, nan = {"loading.strain": 0.5, "loading.stroke": np.nan}, np.nan
    struck = {"loading_mode": "impact", "striker_mass_g": 50.0, "impact_energy_J": 0.2}
    lost = {"status": "stopped", "message": "stopped at strain 0.5: more solver.load_steps"}
    table = summary(
        crush,
        *(struck | {"striker_speed_m_per_s": speed} for speed in (3.1, 3.1004, 3.1 + 1e-15)),
        {"loading.strain": nan, "loading.stroke": 6.1e-3},
        {"stroke_m": 6.1e-3 * (1.0 + 1e-8)} | lost,
    )
    data, ranking = gathered(tmp_path, table), ranked(table, top=None)
    assert len(data["cases"]) == 5
    assert [scene["label"] for scene in data["scenes"]] == list(ranking.lightest_g)
    on_the_page = {case["id"]: data["scenes"][case["scene"]]["label"] for case in data["cases"]}
    assert on_the_page == dict(ranking.table[["case_id", "scene"]].to_numpy())
    (failure,) = data["failures"]
    assert (failure["case"], failure["why"]) == (table["case_id"][5], lost["message"])
    assert [failure["scene"]] == list(ranking.lost)
    assert data["total"] == 6


def test_sweep_without_a_finished_case_has_a_page(tmp_path):
    data = gathered(tmp_path, summary({"status": "stopped", "message": "no"}))
    assert (data["cases"], data["scenes"], len(data["failures"])) == ([], [], 1)


def test_equal_drawings_are_stored_once(tmp_path):
    data = gathered(tmp_path, summary({}, {"platen": "contact"}, {"mass_g": 2.0}))
    assert len(data["drawings"]) == 1
    assert [case["drawing"] for case in data["cases"]] == [0, 0, 0]


def test_shapes_of_the_best_come_first(tmp_path, monkeypatch):
    table = summary(*designs([2.0, 1.0, 3.0], [0.1, 0.4, 0.2]))
    best = ranked(table, budget=0.01).table["case_id"][0]
    whole = gathered(tmp_path, table, budget=[0.01])
    assert len(whole["shapes"]) == 3
    one = len(json.dumps(whole["shapes"][best]))
    monkeypatch.setattr(gather, "SHAPES", int(1.5 * one))
    assert list(gathered(tmp_path, table, budget=[0.01])["shapes"]) == [best]


def test_energies_and_forces_of_the_page_are_those_of_the_curves(tmp_path):
    data, history = gathered(tmp_path, summary({})), there_and_back()
    (case,), (shape,) = data["cases"], data["shapes"].values()
    _, work, *parts = np.array(case["book"]["values"])
    np.testing.assert_allclose(np.sum(parts, axis=0), work, rtol=1e-3, atol=1e-6)
    assert case["book"]["parts"] == ["bending", "lost to friction"]
    highest, done, _ = map(np.array, case["stairs"])  # they end where the platen turns
    assert done[-1] == pytest.approx(history["work_in_J"].max(), rel=1e-4)
    assert absorbed_until(1e9, highest, done) == done[-1]
    time, force = history["time_s"].astype("f4"), history["reaction_top_N"]
    forces = np.interp(squeezed_cell()["time_s"], time, force)
    np.testing.assert_allclose(shape["force"], forces, rtol=1e-3)


def test_curves_of_each_mode():
    history = there_and_back()
    history["reaction_bottom_N"] += 1.0
    crush, blow, load = (
        curve_of(history, {"loading_mode": mode}) for mode in ("displacement", "impact", "force")
    )
    assert crush[1].max() == history["reaction_top_N"].max()
    assert blow[1].max() == crush[1].max() + 1.0
    assert load[1].max() == pytest.approx(100.0 * 4e-3 / HEIGHT)


def test_a_fifth_of_a_full_page_fits_into_a_megabyte(tmp_path, monkeypatch):
    """Curves without any regularity, and a drawing of its own for each design."""
    monkeypatch.setattr(gather, "DRAWINGS", gather.DRAWINGS // 5)
    monkeypatch.setattr(gather, "SHAPES", gather.SHAPES // 5)
    table, rng = sweep(count=MOST // 10), np.random.default_rng(0)
    strain, time = np.linspace(0.0, 0.6, 41), np.linspace(0.0, 1.0, 41)

    def ran(*_):
        history = {name: rng.random(201) for name in there_and_back()}
        history["strain"] = np.linspace(0.0, 0.6, 201)
        frames = {"strain": strain, "time_s": time, "plate_y_m": np.zeros((41, 2))}
        frames |= {"position_m": rng.random((41, 40, 2)) * 0.0125}
        edges = rng.integers(0, 40, (50, 2))
        frames["edges"] = edges[edges[:, 0] != edges[:, 1]]
        return history, frames | {"edge_thickness_m": np.full(len(frames["edges"]), 8e-4)}

    data = page_data(write(tmp_path / "many.h5", table, ran=ran), table, Question())
    assert 400_000 < len(json.dumps(data, separators=(",", ":"))) < 980_000
    assert (len(data["cases"]), data["points"]) == (MOST // 5, 60)
    assert data["shapes"]


UPRIGHT = {"direction": "out_of_plane", "solid_strain": 0.7}


def test_plates_are_drawn_as_their_plan_and_move_as_faces(tmp_path):
    data = gathered(tmp_path, summary(UPRIGHT))
    (drawn,) = data["drawings"]
    assert drawn["box"] == pytest.approx([-0.05, -0.05, 1.1, 1.1])
    (shape,) = data["shapes"].values()
    assert (shape["nodes"], len(shape["quads"]), len(shape["laid"])) == (8, 4, 1)
    assert shape["plates"][1] == [0.0, 1800.0]


def test_a_panel_moves_as_four_periods(tmp_path):
    """Of the tube, 1 mm wide, as a period: its walls at the sides are cut away."""
    row = UPRIGHT | {"sides": "tied, fixed period", "outer_width_m": 2e-3, "depth_m": 2e-3}
    (shape,) = gathered(tmp_path, summary(row))["shapes"].values()
    assert shape["laid"] == [[0.0, 0.0], [0.0, 2.0], [2.0, 0.0], [2.0, 2.0]]
    assert len(shape["quads"]) == 4
