"""The data of a page: what ranks designs, thin curves, shapes while there is room."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from sweep.ranking.curves import with_allowed
from sweep.ranking.question import Question
from sweep.ranking.rank import ranked
from sweep.report.page import gather
from sweep.report.page.gather import curve_of, page_data
from sweep.report.page.thinning import work_until
from sweep.result import Result, Status
from sweep.store.write import Writer
from tests.support.results.page_data import expected, sweep
from tests.support.results.specimens import (
    HEIGHT,
    Named,
    squeezed_cell,
    summary,
    there_and_back,
    write,
)

SCRIPT = Path(gather.__file__).with_name("rank.js")
NODE = shutil.which("node")
QUESTIONS = [
    {"budget": budget, "panel": panel, "force": force}
    for budget in (None, 1.0, 1.5, 40.0)
    for panel in (None, (0.1, 0.05))
    for force in (None, 20.0, 50.0)
]
ASK = """
{script}
const {{ data, questions }} = JSON.parse(require("fs").readFileSync(0, "utf8"));
const told = questions.map((question) => data.scenes.map((_, scene) =>
  ranked(data, {{ ...question, scene }}).placed.map((row) => ({{
    case_id: row.design.id, place: row.place, tied: row.sharing > 1, pareto: row.pareto,
    beyond_model: row.beyond, crossed: row.design.crossed, value: row.value, mass: row.mass,
  }}))));
process.stdout.write(JSON.stringify(told));
"""


def gathered(path, table, **question):
    return page_data(write(path / "trial.h5", table, {"config": "{}"}), table, Question(**question))


def told_by_the_script(data, questions):
    """Rankings by `rank.js`: for each question a list of scenes."""
    asked = json.dumps({"data": data, "questions": questions}, allow_nan=False)
    program = ASK.format(script=SCRIPT.read_text("utf-8"))
    done = subprocess.run(
        [NODE, "-e", program], input=asked, capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    return json.loads(done.stdout)


@pytest.mark.skipif(NODE is None, reason="needs node")
@pytest.mark.parametrize("bars", [("error", "correction"), ("error",), ()])
def test_script_ranks_as_rank_does(tmp_path, bars):
    table = sweep(bars=bars)
    data = gathered(tmp_path, table)
    labels = [scene["label"] for scene in data["scenes"]]
    assert len(labels) == 3
    compared = ties = 0
    for question, told in zip(QUESTIONS, told_by_the_script(data, QUESTIONS), strict=True):
        wanted = expected(table, **question)
        for label, found in zip(labels, told, strict=True):
            if not bars:
                found = [row | {"tied": False} for row in found]
            assert found == wanted.get(label, []), (question, label)
            compared += len(found)
            ties += sum(row["tied"] for row in found)
    assert compared > 300
    assert (ties > 50) == bool(bars)


LIMITS = {
    "max_force": (30.0, 900.0),
    "min_absorbed": (0.5, 20.0),
    "max_mass": (1.5e-3, 0.05),
    "max_stroke": (5e-3, 5e-3),
    "max_deceleration": (350.0, 350.0),
}
"""Limits (SI) of a specimen and of a panel."""
WISHES = [*([name] for name in LIMITS), ["max_force", "min_absorbed"], [*LIMITS]]


ASKED = [question for question in QUESTIONS if question["budget"] in (None, 1.5)]


@pytest.fixture(scope="module")
def free(tmp_path_factory):
    """The data of a page, its table with strokes up to each force, and the number of ranked designs
    of each scene for each of ``ASKED`` where nothing is required.
    """
    folder, table = tmp_path_factory.mktemp("required"), sweep()
    data = gathered(folder, table)
    tables = {
        force: with_allowed(folder / "trial.h5", table, Question(allowed_force=force))
        for force in (None, 20.0, 50.0)
    }
    counts = [
        {scene: len(rows) for scene, rows in expected(table, **question).items()}
        for question in ASKED
    ]
    return data, tables, counts


@pytest.mark.skipif(NODE is None, reason="needs node")
@pytest.mark.parametrize("names", WISHES, ids="+".join)
def test_script_requires_what_rank_requires(free, names):
    """The designs that miss a limit have no place, of a specimen or of a panel, as in `rank`."""
    data, tables, counts = free
    questions, ranked_before = [], []
    for question, count in zip(ASKED, counts, strict=True):
        for of_panel, per in enumerate(("specimen", "panel")):
            if per == "specimen" or (question["panel"] and question["force"] is None):
                require = {name: LIMITS[name][of_panel] for name in names}
                questions.append({**question, "require": require, "per": per})
                ranked_before.append(count)
    dropped = kept = 0
    told_by = told_by_the_script(data, questions)
    for question, before, told in zip(questions, ranked_before, told_by, strict=True):
        wanted = expected(tables[question["force"]], **question)
        for scene, found in zip(data["scenes"], told, strict=True):
            if question["force"] is None or scene["mode"] == "displacement":
                assert found == wanted.get(scene["label"], []), (question, scene["label"])
            kept += len(found)
            dropped += before.get(scene["label"], 0) - len(found)
    assert kept > 0
    assert dropped > 25


@pytest.mark.skipif(NODE is None, reason="needs node")
def test_energies_between_the_stored_forces_are_read_from_curves(tmp_path):
    table = summary({"peak_force_N": 20.8, "absorbed_energy_at_20N_J": 1.0})
    data = gathered(tmp_path, table)
    ((found,),), ((stored,),) = told_by_the_script(
        data, [{"budget": 5.0, "panel": None, "force": force} for force in (20.3, 20.0)]
    )
    history = there_and_back()
    expected_work = np.interp(20.3, history["reaction_top_N"][:21], history["work_in_J"][:21])
    assert found["value"] == pytest.approx(expected_work, rel=1e-3)
    assert stored["value"] == 1.0


@pytest.mark.skipif(NODE is None, reason="needs node")
def test_an_allowed_force_may_be_that_of_the_panel(tmp_path):
    """A specimen has its share of it, which is read from curves even where a column has it."""
    known = {"absorbed_energy_at_24N_J": 9.0}
    table = summary(*[known | {"outer_width_m": width} for width in (0.012, 0.013, 0.0165)])
    data, panel = gathered(tmp_path, table), (0.1, 0.05)
    question = Question(panel=panel, allowed_force=840.0, per="panel")
    at_force = with_allowed(tmp_path / "trial.h5", table, question)
    (wanted,) = expected(at_force, panel=panel, force=840.0, per="panel").values()
    asked = {"budget": None, "panel": panel, "force": 840.0, "per": "panel"}
    no_panel = asked | {"panel": None, "force": 24.0}
    (found,), ((alone, *_),) = told_by_the_script(data, [asked, no_panel])
    assert [row["case_id"] for row in found] == [row["case_id"] for row in wanted]
    values = [row["value"] for row in found]
    assert values == pytest.approx([row["value"] for row in wanted], rel=1e-3)
    assert 3.5 > values[0] > 1.1 * values[1] > 1.2 * values[2]  # 30, 35 and 40 specimens
    assert alone["value"] == pytest.approx(9.0 / alone["mass"])


def test_page_has_every_finished_case_once_and_every_failure(tmp_path):
    lost = {"status": "stopped", "message": "stopped at strain 0.5: more solver.load_steps"}
    table = summary({}, lost, {"platen": "contact"})
    data = gathered(tmp_path, table)
    ids = list(table["case_id"])
    assert [case["id"] for case in data["cases"]] == [ids[0], ids[2]]
    assert [case["scene"] for case in data["cases"]] == [0, 1]
    (failure,) = data["failures"]
    assert (failure["case_id"], failure["message"]) == (ids[1], lost["message"])
    assert data["total"] == 3


def test_sweep_without_a_finished_case_has_a_page(tmp_path):
    data = gathered(tmp_path, summary({"status": "stopped", "message": "no"}))
    assert (data["cases"], data["scenes"], len(data["failures"])) == ([], [], 1)


def test_equal_drawings_are_stored_once(tmp_path):
    data = gathered(tmp_path, summary({}, {"platen": "contact"}, {"mass_g": 2.0}))
    assert len(data["drawings"]) == 1
    assert [case["drawing"] for case in data["cases"]] == [0, 0, 0]


def test_shapes_of_the_best_come_first(tmp_path, monkeypatch):
    table = summary(
        {"mass_g": 2.0, "absorbed_energy_J": 0.1},
        {"mass_g": 1.0, "absorbed_energy_J": 0.4},
        {"mass_g": 3.0, "absorbed_energy_J": 0.2},
    )
    best = ranked(table, budget=0.01).table["case_id"][0]
    whole = gathered(tmp_path, table, budget=[0.01])
    assert len(whole["shapes"]) == 3
    one = len(json.dumps(whole["shapes"][best]))
    monkeypatch.setattr("sweep.report.page.gather.SHAPES", int(1.5 * one))
    assert list(gathered(tmp_path, table, budget=[0.01])["shapes"]) == [best]


def test_energies_of_the_page_add_up_to_the_work(tmp_path):
    (case,) = gathered(tmp_path, summary({}))["cases"]
    _, work, *parts = np.array(case["book"]["values"])
    np.testing.assert_allclose(np.sum(parts, axis=0), work, rtol=1e-3, atol=1e-6)
    assert case["book"]["parts"] == ["bending", "lost to friction"]


def test_stairs_end_where_the_platen_turns(tmp_path):
    (case,) = gathered(tmp_path, summary({}))["cases"]
    highest, done = map(np.array, case["stairs"])
    history = there_and_back()
    assert done[-1] == pytest.approx(history["work_in_J"].max(), rel=1e-4)
    assert work_until(1e9, highest, done) == done[-1]


def test_curves_of_each_mode():
    history = there_and_back()
    history["reaction_bottom_N"] += 1.0
    crush, blow, load = (
        curve_of(history, {"loading_mode": mode}) for mode in ("displacement", "impact", "force")
    )
    assert crush[1].max() == history["reaction_top_N"].max()
    assert blow[1].max() == crush[1].max() + 1.0
    assert load[1].max() == pytest.approx(100.0 * 4e-3 / HEIGHT)


def test_frames_have_the_force_of_their_time(tmp_path):
    table = summary({})
    (shape,) = gathered(tmp_path, table)["shapes"].values()
    history = there_and_back()
    known = np.interp(
        squeezed_cell()["time_s"], history["time_s"].astype("f4"), history["reaction_top_N"]
    )
    np.testing.assert_allclose(shape["force"], known, rtol=1e-3)


def test_five_hundred_cases_fit_into_five_megabytes(tmp_path):
    """Curves without any regularity, and a drawing of its own for each design."""
    table = sweep(count=250)
    assert len(table) == 500
    rng, results = np.random.default_rng(0), []
    for row in table.to_dict("records"):
        case_id, status, message = (row.pop(name) for name in ("case_id", "status", "message"))
        history = {name: rng.random(201) for name in there_and_back()}
        history["strain"] = np.linspace(0.0, 0.6, 201)
        nodes = rng.random((41, 40, 2)) * 0.0125
        edges = rng.integers(0, 40, (50, 2))
        edges = edges[edges[:, 0] != edges[:, 1]]
        frames = {
            "strain": np.linspace(0.0, 0.6, 41),
            "time_s": np.linspace(0.0, 1.0, 41),
            "position_m": nodes,
            "plate_y_m": np.zeros((41, 2)),
            "edges": edges,
            "edge_thickness_m": np.full(len(edges), 8e-4),
        }
        results.append(Result(Named(case_id), Status(status), message, row, history, frames))
    path = tmp_path / "many.h5"
    with Writer(path) as writer:
        writer.append(results)
        writer.fold()
    data = page_data(str(path), table, Question())
    size = len(json.dumps(data, separators=(",", ":")))
    assert 2_000_000 < size < 4_900_000
    assert data["points"] == 60
    assert 0 < len(data["shapes"]) < 500


def test_plates_are_drawn_as_their_plan_and_move_as_lines(tmp_path):
    data = gathered(tmp_path, summary({"direction": "out_of_plane", "solid_strain": 0.7}))
    (drawn,) = data["drawings"]
    assert drawn["box"] == pytest.approx([-0.05, -0.05, 1.1, 1.1])
    (shape,) = data["shapes"].values()
    assert shape["nodes"] == 8
    assert shape["plates"] == [[None, None]] * 3
