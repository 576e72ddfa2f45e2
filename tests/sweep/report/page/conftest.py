"""The script of the page, run as a browser runs it."""

import json
from pathlib import Path

import pytest
from py_mini_racer import MiniRacer

from sweep.report.page import gather


@pytest.fixture(scope="module")
def page_answers(request):
    """Answers of `rank.js` by `answersOf` in `ASK` of a module: for each question a list of scenes.

    The page has budgets in g.
    """
    with MiniRacer() as engine:
        script = Path(gather.__file__).with_name("rank.js")
        engine.eval(script.read_text("utf-8") + request.module.ASK)

        def ask(data, questions):
            in_g = [one | {"budget": one["budget"] and 1e3 * one["budget"]} for one in questions]
            asked = json.dumps({"data": data, "questions": in_g}, allow_nan=False)
            return json.loads(engine.eval(f"JSON.stringify(answersOf({asked}))"))

        yield ask
