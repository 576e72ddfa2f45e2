"""A page that leaves designs out: its first designs are first among all, or it says that they may
not be.
"""

import numpy as np
import pytest

from sweep.columns import absorbed_energy_column
from sweep.ranking.curves import reached, with_allowed
from sweep.ranking.question import Question
from sweep.ranking.rank import ranked
from sweep.report.page import selection
from sweep.report.page.gather import page_data
from sweep.report.page.selection import layers
from tests.support.results.questions import (
    FORCES,
    OTHERS,
    curve,
    each_budget,
    random_question,
    random_sweep,
    write_curves,
)

COUNT, SELECTED = 90, 40  # designs of each of two scenes; of both in the page
QUESTIONS = 12
ASK = """
function answersOf({ data, questions }) {
  return questions.map((question) => data.scenes.map((_, scene) => {
    const found = ranked(data, { ...question, scene });
    const { certain, better, nearest } = found;
    const placed = found.placed.map((row) => [row.design.id, row.place]);
    return { certain, better, placed, nearest: nearest && nearest.design.id };
  }));
}
"""


@pytest.fixture
def few(monkeypatch):
    """Pages hold few designs, and groups have few members."""
    monkeypatch.setattr(selection, "MOST", SELECTED)
    monkeypatch.setattr(selection, "SAMPLE", 6)


def many(path, seed):
    """A file of random designs, its summary and data; energies and forces come from curves."""
    rng = np.random.default_rng(seed)
    table, _ = random_sweep(rng, OTHERS[seed % 4], COUNT)
    factors = rng.uniform(0.5, 2.0, len(table))
    curves = [curve(factor) for factor in factors]
    whole = np.array([each["work_in_J"].max() for each in curves])
    within = table["absorbed_energy_within_model_J"] / table["absorbed_energy_until_packed_J"]
    columns = {
        absorbed_energy_column(force): [reached(each, force)[0] for each in curves]
        for force in FORCES
    }
    table = table.assign(
        absorbed_energy_J=whole,
        absorbed_energy_until_packed_J=whole,
        absorbed_energy_within_model_J=within * whole,
        peak_force_N=[each["reaction_top_N"].max() for each in curves],
        **columns,
    )
    file = write_curves(path / "many.h5", table, factors)
    return file, table, page_data(file, table, Question()), rng


def among_all(file, table, question, cache):
    """The rows with a place of each scene, by its label, and the outcomes of the requirements."""
    asked = {name: question[name] for name in ("panel", "require", "per")}
    of = Question(None, question["panel"], None, None, question["force"], per=question["per"])
    known = with_allowed(file, table, of, cache)
    ranking = ranked(known, question["budget"], **asked, top=None, allowed_force=question["force"])
    rows = {label: ranking.table[ranking.table["scene"] == label] for label in ranking.lightest_g}
    return rows, ranking.outcomes


@pytest.mark.parametrize("seed", range(3))
def test_first_places_are_those_among_all_designs_or_the_page_says_so(
    page_answers, few, tmp_path, seed
):
    """Any question may be asked: budget, panel, allowed force, requirements."""
    file, table, data, rng = many(tmp_path, seed)
    assert len(data["cases"]) == SELECTED
    assert sum(scene["designs"] for scene in data["scenes"]) > 3 * SELECTED
    drawn, cache = [random_question(rng, table) for _ in range(QUESTIONS)], {}
    questions = [each_budget(question)[0] for question in drawn]
    sure = better = 0
    answers = page_answers(data, questions)
    for question, scenes in zip(questions, answers, strict=True):
        every, outcomes = among_all(file, table, question, cache)
        for scene, found in zip(data["scenes"], scenes, strict=True):
            if question["force"] is not None and not scene["driven"]:
                continue
            rows = every[scene["label"]]
            places = [list(pair) for pair in zip(rows["case_id"], rows["place"], strict=True)]
            assert found["placed"][: found["certain"]] == places[: found["certain"]], question
            sure += found["certain"]
            better += found["better"]
            if not (found["better"] or found["placed"]):
                assert not places, question
                (outcome,) = outcomes.get(scene["label"]) or [None]
                if outcome is not None and len(outcome.nearest):
                    assert found["nearest"] == outcome.nearest["case_id"].item(), question
    assert sure > QUESTIONS
    assert 0 < better < 1.5 * QUESTIONS


def test_page_has_the_first_for_every_budget_up_to_the_forces_of_the_columns(
    page_answers, few, tmp_path, monkeypatch
):
    monkeypatch.setattr(selection, "MOST", 2 * SELECTED)
    file, table, data, _ = many(tmp_path, 5)
    masses = np.sort(table["mass_g"].dropna().unique())
    budgets = [None, *(1e-3 * masses[len(masses) // 2 :: 8])]
    plain = {"panel": None, "per": "specimen", "require": {}}
    questions = [plain | {"budget": b, "force": f} for b in budgets for f in (None, *FORCES)]
    answers = page_answers(data, questions)
    for question, (found, *_) in zip(questions, answers, strict=True):
        first = next(iter(among_all(file, table, question, {})[0].values())).iloc[0]
        assert found["placed"][0] == [first["case_id"], 1]
        assert found["better"] == bool(first["beyond_model"] or first["crossed"])


def test_layers_hold_the_best_below_every_limit():
    rng = np.random.default_rng(3)
    limited, merit = rng.uniform(size=200), rng.uniform(size=200)
    merit[::9] = np.nan
    first = np.concatenate([*layers(limited, merit, 4)])
    for limit in limited:
        within = np.flatnonzero((limited <= limit) & np.isfinite(merit))
        assert {*within[np.argsort(-merit[within])][:4]} <= {*first}


def test_the_page_of_few_designs_has_all(tmp_path):
    _, table, data, _ = many(tmp_path, 1)
    assert {design["id"] for design in data["cases"]} == {*table["case_id"][table["loaded"] == 1]}
    assert [scene["others"] for scene in data["scenes"]] == [[], []]
    assert [scene["front_of_others"] for scene in data["scenes"]] == [[], []]
    assert all(scene["stopped"] == 0 for scene in data["scenes"])
