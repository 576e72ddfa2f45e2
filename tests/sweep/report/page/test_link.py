"""The link of the page, `link.js`: it opens with the question that it was made of, or with none."""

import json
from pathlib import Path

import pytest
from py_mini_racer import MiniRacer

from sweep.report.page import gather

SCRIPT = Path(gather.__file__).with_name("link.js")
DATA = {"scenes": [{}, {}], "measures": {"max_force": {}, "min_absorbed": {}}}
NONE = {"scene": 0, "budget": None, "panel": None, "force": None, "per": "specimen", "require": {}}


@pytest.fixture(scope="module")
def evaluate():
    """The value of an expression of the script."""
    with MiniRacer() as engine:
        engine.eval(SCRIPT.read_text("utf-8"))
        yield lambda words: json.loads(engine.eval(f"JSON.stringify({words})"))


@pytest.mark.parametrize(
    "asked",
    [
        NONE,
        NONE | {"scene": 1, "budget": 42.5242847, "panel": [0.1, 1 / 30]},
        NONE | {"force": 1e-7, "per": "panel", "require": {"max_force": 60, "min_absorbed": 0.3}},
    ],
)
def test_a_link_keeps_the_question(evaluate, asked):
    link = evaluate(f"linkOf({json.dumps(asked)})")
    assert evaluate(f"questionOf({json.dumps(link)}, {json.dumps(DATA)})") == asked


@pytest.mark.parametrize("link", ["", "scene=2", "scene=-1", "scene=length", "x", "=&=&", "scene"])
def test_what_names_no_scene_is_no_question(evaluate, link):
    assert evaluate(f"questionOf({json.dumps(link)}, {json.dumps(DATA)})") is None


@pytest.mark.parametrize(
    "words",
    [
        "budget=-1&force=Infinity&per=all",
        "budget=NaN&panel=0.1&max_force=0",
        "panel=0.1x-1&force=1e999&require=1&__proto__=3",
        "panel=1x2x3&budget=<img src=x onerror=alert(1)>&max_force=none",
    ],
)
def test_what_a_link_cannot_mean_is_left_out(evaluate, words):
    link = json.dumps(f"scene=0&{words}")
    assert evaluate(f"questionOf({link}, {json.dumps(DATA)})") == NONE
