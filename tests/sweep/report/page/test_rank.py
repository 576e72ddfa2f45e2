"""The ranking of the page, `rank.js`, against Python's, on random sweeps and questions."""

import numpy as np
import pytest

from sweep.ranking.curves import with_allowed
from sweep.ranking.merit import UNEQUAL
from sweep.ranking.question import Question, RankError
from sweep.ranking.rank import ranked
from sweep.ranking.unfinished import PLACES
from sweep.report.page.gather import page_data
from tests.support.results.questions import (
    OTHERS,
    each_budget,
    random_question,
    random_sweep,
    read_from_curves,
    write_curves,
)

SEEDS, ASKED = (7, 28, 21, 18, 23), 16
DIGITS = 1e-3  # relative error of values that the page reads from curves of four digits
NEEDED = ("energy", "force", "stroke")
COUNTS = ("designs", "fulfil", "doubtful", "coarse", "failed", "unknown", "open")
ASK = """
function answersOf({ data, questions }) {
  return questions.map((question) => data.scenes.map((_, scene) => {
    const asked = { ...question, scene };
    const found = ranked(data, asked);
    return {
      placed: found.placed.map((row) => ({
        case_id: row.design.id, place: row.place, pareto: row.pareto,
        tied: row.sharing > 1,
        beyond_model: row.beyond, crossed: row.design.crossed,
        value: row.value, mass: row.mass, early: row.early || row.open,
      })),
      refused: found.refused,
      passed_over: found.passedOver,
      nearest: found.nearest ? found.nearest.design.id : null,
      stopped: found.stopped.map(({ row, best, least }) => [row.design.id, best, least]),
      lightest: found.lightestMeeting ? found.lightestMeeting.design.id : null,
      misses: found.nearest ? found.nearest.misses : {},
      needed: rectangle(data, found.rows, asked),
      outcome: outcomeOf(data, found, asked),
    };
  }));
}
"""


def counted_until(question):
    """The part of a random question that tells up to which force energy is counted."""
    force, panel, per = (question[name] for name in ("force", "panel", "per"))
    return Question(allowed_force=force, panel=panel, per=per)


def expected(table, question):
    asked = {name: question[name] for name in ("panel", "require", "per")}
    budgets = question["budgets"]
    ranking = ranked(table, budgets, **asked, top=None, allowed_force=question["force"])
    return [_within(ranking, k, bool(question["require"])) for k in range(len(budgets) or 1)]


def _within(ranking, k, required):
    def own(rows, label):
        rows = rows[rows["scene"] == label]
        return rows[rows["budget_g"] == ranking.budgets_g[k]] if ranking.budgets_g else rows

    table = ranking.table
    table = table.assign(
        value=[table.at[k, by] for k, by in table["ranked_by"].items()],
        mass=table[ranking.mass],
        early=table["ends_early"],
    )
    names = ["case_id", "place", "tied", "pareto", "beyond_model", "crossed"]
    names += ["value", "mass", "early"]
    scenes = {}
    for label in ranking.lightest_g:
        rows, stopped = own(table, label), own(ranking.unfinished, label)
        places = stopped[["case_id", *PLACES]].itertuples(index=False, name=None)
        scenes[label] = {
            "placed": rows[names].to_dict("records"),
            "passed_over": int(rows["passed_over"].iloc[0]) if len(rows) else 0,
            "stopped": [[case, n, None if np.isnan(m) else m] for case, n, m in places],
        }
        if required:
            scenes[label] |= _of_requirements(ranking.outcomes[label][k])
    return scenes


def _of_requirements(outcome):
    ids = {name: list(getattr(outcome, name)["case_id"]) for name in ("nearest", "lightest")}
    known = np.isfinite(outcome.stroke)
    counts = {name: getattr(outcome, name) for name in COUNTS}
    close = {name: len(rows) for name, rows in outcome.close.items()}
    return {
        "outcome": counts | {"close": close},
        "nearest": next(iter(ids["nearest"]), None),
        "lightest": next(iter(ids["lightest"]), None),
        "misses": dict(outcome.misses),
        "needed": {name: getattr(outcome, name) for name in NEEDED} if known else None,
    }


def of_the_page(scene, names):
    """The answer of the page for one scene, in the form of `expected`."""
    misses = {name: share for name, share in scene["misses"].items() if share}
    needed = scene["needed"] and {name: scene["needed"][name] for name in NEEDED}
    return {name: (scene | {"misses": misses, "needed": needed})[name] for name in names}


def blurred(scene):
    """A scene without the choice of the nearest among designs that miss alike, which is
    round-off.
    """
    if "misses" not in scene:
        return scene
    worst = max(scene["misses"].values(), default=0.0)
    return scene | {"misses": worst, "nearest": bool(scene["nearest"])}


def near(answer):
    """An answer that equals any whose fractions differ a little."""
    if isinstance(answer, float):
        return pytest.approx(answer, rel=DIGITS)
    if isinstance(answer, list):
        return [near(each) for each in answer]
    if isinstance(answer, dict):
        return {name: near(each) for name, each in answer.items()}
    return answer


def asked_of_both(page_answers, path, seed):
    """Random questions of a random sweep, and for each scene the answers of the page and of
    Python.
    """
    rng = np.random.default_rng(seed)
    table, factors = random_sweep(rng, OTHERS[seed % len(OTHERS)])
    file = write_curves(path / "random.h5", table, factors)
    data, known = page_data(file, table, Question()), {}
    questions = [random_question(rng, table) for _ in range(ASKED)]
    each = [one for question in questions for one in each_budget(question)]
    wanted = []
    for question in questions:
        wanted += expected(with_allowed(file, table, counted_until(question), known), question)
    answers = page_answers(data, each)
    for question, scenes, found in zip(each, wanted, answers, strict=True):
        for scene, answer in zip(data["scenes"], found, strict=True):
            if question["force"] is None or scene["driven"]:
                yield question, answer, scenes[scene["label"]]


@pytest.mark.parametrize("seed", SEEDS)
def test_page_and_python_rank_alike(page_answers, tmp_path, seed):
    """Values that the page reads from curves have four digits."""
    rows, missing, nearest, border, stopped, passed_over, close = [], 0, 0, 0, 0, 0, 0
    unknown, longer = 0, 0
    for question, found, wanted in asked_of_both(page_answers, tmp_path, seed):
        one, other = of_the_page(found, wanted), wanted
        if read_from_curves(question):
            assert blurred(one) == near(blurred(other)), question
        else:
            assert one == other, question
        rows += found["placed"]
        missing += found["outcome"]["designs"] - found["outcome"]["fulfil"]
        unknown += sum(found["outcome"]["unknown"].values())
        longer += found["outcome"]["open"]
        passed_over += found["passed_over"]
        stopped += sum(best > 1 for _, best, _ in found["stopped"])
        stopped += sum(least is not None for _, _, least in found["stopped"])
        nearest += bool(found["nearest"])
        close += sum(found["outcome"]["close"].values())
        most = 1e3 * (question["budget"] or np.inf)
        border += sum(0.0 < abs(most / row["mass"] - 1.0) < 5e-9 for row in found["placed"])
    counts = [sum(row[flag] for row in rows) for flag in ("pareto", "beyond_model", "crossed")]
    assert min(*counts, missing, stopped, passed_over) > 5
    assert min(nearest, border, unknown, longer) > 0
    assert close > 0


@pytest.mark.parametrize("seed", range(len(OTHERS)))
def test_page_and_python_refuse_alike_what_periods_cannot_be_compared_by(
    page_answers, tmp_path, seed
):
    """Python refuses a question for all scenes, of which the page shows one."""
    rng = np.random.default_rng(seed)
    table, factors = random_sweep(rng, OTHERS[seed])
    table["sides"] = "tied"
    file = write_curves(tmp_path / "periods.h5", table, factors)
    data, known, refused = page_data(file, table, Question()), {}, 0
    free = {"budgets": [], "budget": None}
    questions = [random_question(rng, table) | free for _ in range(ASKED)]
    for question, scenes in zip(questions, page_answers(data, questions), strict=True):
        rows = with_allowed(file, table, counted_until(question), known)
        if any(scene["refused"] for scene in scenes):
            with pytest.raises(RankError, match=UNEQUAL):
                expected(rows, question)
            assert not any(scene["placed"] for scene in scenes if scene["refused"])
            refused += 1
        else:
            (wanted,) = expected(rows, question)
            for scene, own in zip(scenes, wanted.values(), strict=True):
                assert len(scene["placed"]) == len(own["placed"])
    assert 2 < refused < ASKED - 2
