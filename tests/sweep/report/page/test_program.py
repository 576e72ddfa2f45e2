"""The whole program of the page: that no question, scene, design or frame makes it fail."""

import json

import numpy as np
import pytest

from sweep.ranking.question import Question
from sweep.report.page.write import write_page
from tests.support.document import opened
from tests.support.results.questions import OTHERS, random_question, random_sweep, write_curves

QUESTIONS = 12
ASK = """
(() => {{
  Object.assign(asked, {question});
  enter();
  return [$("sentence").textContent, now.refused, now.placed.length];
}})()
"""
LOOK = """
(() => {
  for (const head of document.getElementById("table").tHead)
    if (head.name === "button") head.dispatch("click");
  if ($("all").listeners.has("click")) $("all").dispatch("click");
  for (const { design } of now.rows.slice(0, 3)) {
    lookAt(design.id);
    play();
    for (const step of timers) step?.();
    stop();
  }
  for (const dot of document.getElementById("map"))
    for (const event of ["pointerenter", "pointerleave"])
      if (dot.listeners.has(event)) dot.dispatch(event);
  return $("one-words").textContent;
})()
"""


def page_of(folder, table, factors):
    """The page (HTML) of invented results."""
    file = write_curves(folder / "random.h5", table, factors)
    return write_page(str(file), table, Question(), folder / "random.html").read_text("utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """A page of two scenes of crushes."""
    folder = tmp_path_factory.mktemp("page")
    return page_of(folder, *random_sweep(np.random.default_rng(0), OTHERS[0]))


@pytest.mark.parametrize(("seed", "sides"), [(0, "free"), (1, "tied"), (2, "free"), (3, "tied")])
def test_every_question_is_answered(tmp_path, seed, sides):
    rng = np.random.default_rng(seed)
    table, factors = random_sweep(rng, OTHERS[seed])
    table["sides"] = sides
    answers, looks = [], []
    with opened(page_of(tmp_path, table, factors)) as run:
        answers.append(run(ASK.format(question="{}")))
        for number in range(QUESTIONS):
            question = random_question(rng, table)
            budget = next(iter(question.pop("budgets")), None)
            question |= {"scene": number % 2, "budget": budget and 1e3 * budget}
            answers.append(run(ASK.format(question=json.dumps(question))))
            looks.append(run(LOOK))
    best = sum(words.startswith("The best design") for words, _, _ in answers)
    assert best == sum(placed > 0 for _, _, placed in answers) > 2
    refused = [words for words, refused, _ in answers if refused]
    assert all("periods of wide panels differ in area" in words for words in refused)
    assert bool(refused) == (sides == "tied")
    assert any(looks)


TYPE = """
(() => {{
  for (const name of ["budget", "force", "max_force", "width"]) {{
    $(name).value = "{text}";
    $(name).dispatch("input");
  }}
  return [asked.budget, asked.force, asked.panel, asked.require.max_force ?? null];
}})()
"""


@pytest.mark.parametrize("text", ["", "-5", "0", "1e300"])
def test_a_number_that_cannot_be_asked_for_asks_for_nothing(page, text):
    with opened(page) as run:
        assert run(TYPE.format(text="50")) == [50.0, 50.0, [0.05, 0.1], 50.0]
        assert run(TYPE.format(text=text)) == [None, None, [0.05, 0.1], None]


def test_a_force_of_no_panel_is_asked_of_nothing(page):
    question = {"panel": [0.1, 0.05], "per": "panel", "force": 500.0}
    with opened(page) as run:
        run(ASK.format(question=json.dumps(question)))
        assert run("asked.force") == 500.0
        run(ASK.format(question=json.dumps({"panel": None})))
        assert run("[asked.force, $('force-box').hidden]") == [None, True]


REQUIRE = """
(() => {{
  asked.require = {{ max_force: 60 }};
  const counts = {{ designs: 5, fulfil: 3, doubtful: 0, coarse: 0, open: 0 }};
  const each = {{ failed: {{ max_force: 2 }}, unknown: {{}}, close: {{}} }};
  outcomeOf = () => ({{ ...counts, ...each, ...{changes} }});
  return requiredText();
}})()
"""


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ("{}", "3 of 5 designs fulfil this; the others fail: force (2)."),
        (
            "{ coarse: 1 }",
            "3 of 5 designs fulfil this; the others fail: force (2). "
            "1 of those that do is marked i: with shorter steps it may fail.",
        ),
        (
            "{ coarse: 2, failed: {}, fulfil: 5, doubtful: 3 }",
            "5 of 5 designs fulfil this, 3 of them marked ! or x. "
            "2 of those that do are marked i: with shorter steps they may fail.",
        ),
        (
            "{ close: { max_force: 1 }, unknown: { max_force: 2 } }",
            "3 of 5 designs fulfil this; the others fail: force (2). 2 without a value for force: "
            "time steps are too long for peaks (solver.time_step). 1 meets or misses the limit of "
            "force by less than the uncertainty of the value.",
        ),
        (
            "{ failed: { max_force: 2, max_mass: 1 }, open: 1 }",
            "3 of 5 designs fulfil this; the others fail: force (2), mass (1); some fail several. "
            "1 of those that fail may absorb enough in a longer crush: theirs ended before "
            "densification.",
        ),
        ("{ designs: 0 }", ""),
    ],
)
def test_requirements_are_counted_in_words(page, changes, said):
    with opened(page) as run:
        words = run(REQUIRE.format(changes=changes))
    assert words == f"Required of the part: force at most 60 N. {said}".strip()
