"""The link of the page, `link.js`: it opens with the question that it was made of, or with none."""

import json
from pathlib import Path

import pytest
from py_mini_racer import MiniRacer

from sweep.report.page import gather

SCRIPT = Path(gather.__file__).with_name("link.js")
DATA = {
    "scenes": [{"label": "crushed to 60 %"}, {"label": "dead load of 5 N & more"}],
    "measures": {"max_force": {}, "min_absorbed": {}},
}
NONE = {"scene": 0, "budget": None, "panel": None, "force": None, "per": "specimen", "require": {}}
USUAL = NONE | {"budget": 25, "per": "panel", "require": {"max_force": 60}}


@pytest.fixture(scope="module")
def evaluate():
    with MiniRacer() as engine:
        engine.eval(SCRIPT.read_text("utf-8"))
        yield lambda words: json.loads(engine.eval(f"JSON.stringify({words})"))


def question(evaluate, link):
    """The question of a link, without the unit of its budget."""
    said = evaluate(f"questionOf({json.dumps(link)}, {json.dumps(DATA)}, {json.dumps(USUAL)})")
    return said and {name: value for name, value in said.items() if name != "unit"}


@pytest.mark.parametrize(
    "asked",
    [
        NONE,
        NONE | {"scene": 1, "budget": 42.5242847, "panel": [0.1, 1 / 30]},
        NONE | {"force": 1e-7, "per": "panel", "require": {"max_force": 60, "min_absorbed": 0.3}},
    ],
)
def test_a_link_keeps_the_question(evaluate, asked):
    link = evaluate(f'linkOf({json.dumps(asked)}, "1", {json.dumps(DATA)})')
    assert question(evaluate, link) == asked


@pytest.mark.parametrize("link", ["", "scene=1", "scene=length", "x", "=&=&", "scene", "budget=5"])
def test_what_names_no_scene_is_no_question(evaluate, link):
    assert question(evaluate, link) is None


@pytest.mark.parametrize(
    "words",
    [
        "",
        "budget=-1&force=Infinity&per=all",
        "budget=NaN&panel=0.1&max_force=0",
        "budget=25%20kg&panel=0.1x-1&force=1e999&require=1&__proto__=3",
        "panel=1x2x3&budget=<img src=x onerror=alert(1)>&max_force=none",
    ],
)
def test_what_a_link_does_not_say_is_as_the_config_asks(evaluate, words):
    assert question(evaluate, f"scene=crushed to 60 %25&{words}") == USUAL


def test_what_a_link_takes_away_is_not_asked(evaluate):
    assert question(evaluate, "scene=crushed%20to%2060%20%25&budget=none&per=specimen") == NONE
