"""The page in a browser: the rankings of its sliders, and that nothing in it fails."""

import io
import json
import shlex
from time import sleep
from xml.etree import ElementTree

import pandas as pd
import pytest

from sweep.ranking.question import Question
from sweep.ranking.rank import rank
from sweep.report.page.write import write_page
from sweep.report.tables.marks import marks
from tests.support.browser import CHROMIUM, browser
from tests.support.command import crumple
from tests.support.results.page_data import sweep
from tests.support.results.specimens import summary, write

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="needs chromium (a package of Debian)")

CONFIG = {"name": "<b>trial</b>", "rank": {"budgets": [0.03, 0.06], "panel": [0.1, 0.05]}}
QUESTION = Question(CONFIG["rank"]["budgets"], CONFIG["rank"]["panel"])
ROWS = """
document.getElementById("all").hidden || view.all || document.getElementById("all").click(),
[...document.querySelectorAll("#table tbody tr")].map((row) =>
  [row.dataset.id, row.children[1].textContent])
"""
SET = """
(() => {{
  const input = document.getElementById("{name}");
  input.{what} = {value};
  input.dispatchEvent(new Event("{event}"));
}})()
"""


@pytest.fixture(scope="module")
def table():
    known = sweep(28, more={"material": "<img src=x onerror=alert(1)>"})
    undrawn = ["walls of 1.5 lines" if k % 3 == 1 else "" for k in range(len(known))]
    unpacked = [k % 4 == 2 for k in range(len(known))]
    return known.assign(
        does_not_print=undrawn,
        stretch_over_curve=[1.5 if k % 7 == 3 else 0.5 for k in range(len(known))],
        densification_strain=known["densification_strain"].mask(unpacked),
    )


@pytest.fixture(scope="module")
def file(tmp_path_factory, table):
    folder = tmp_path_factory.mktemp("page")
    file = write(folder / "trial.h5", table, {"config": json.dumps(CONFIG)})
    write_page(file, table, QUESTION, folder / "trial.html")
    return file


@pytest.fixture(scope="module")
def chromium():
    with browser() as tab:
        yield tab


@pytest.fixture
def tab(chromium, file):
    """The page as it opens; afterwards nothing may have failed or come from elsewhere."""
    chromium.open(file.replace(".h5", ".html"))
    yield chromium
    assert chromium.complaints == []
    assert {url.partition(":")[0] for url in chromium.asked_for} <= {"file", "about", "blob"}
    files = [url for url in chromium.asked_for if url.startswith("file:")]
    assert {url.rpartition("/")[2] for url in files} == {"trial.html"}


def text(tab, name):
    return tab.run(f'document.getElementById("{name}").textContent')


def put(tab, name, value, what="value", event="input"):
    tab.run(SET.format(name=name, value=json.dumps(value), what=what, event=event))


def places(texts):
    """Numbers of places without their marks."""
    return [int(text.rstrip("=*!xifs^purb")) for text in texts]


def ranked_by_the_command(tab, capsys, file, scene=0):
    """Ids and places that the command shown in the page prints, for the scene of this number."""
    words = shlex.split(tab.run('document.querySelector("#command code").textContent'))
    assert words[:3] == ["crumple", "rank", "trial.h5"]
    status, out, _ = crumple(capsys, "rank", file, *words[3:], "--csv", "--top", "999")
    assert status == 0
    printed = pd.read_csv(io.StringIO(out), dtype={"case_id": str})
    rows = printed[printed["scene"] == printed["scene"].unique()[scene]]
    return list(rows["case_id"]), list(rows["place"])


MOVES = [
    {},
    {"budget-slide": "900", "force-slide": "1", "force": "20"},
    {"width-slide": "350", "height": "75", "budget": "61"},
    {"unit": "28.349523125", "budget": "2"},
    {"min_absorbed": "0.3", "max_force": "60"},
    {"min_absorbed": "12", "per": "panel"},
    {"force": "24.5"},
    {"force": "700", "per": "panel"},
    {"scene": "1"},
    {"scene": "2"},
]


@pytest.mark.parametrize("moves", MOVES)
def test_sliders_rank_as_the_command_that_is_shown(tab, capsys, file, moves):
    before, scene = tab.run(ROWS), int(moves.get("scene", 0))
    for name, value in moves.items():
        put(tab, name, value, event="change" if name in ("unit", "per", "scene") else "input")
    shown = tab.run(ROWS)
    ids, order = ranked_by_the_command(tab, capsys, file, scene)
    assert ([row[0] for row in shown], places(row[1] for row in shown)) == (ids, order)
    assert len(ids) > 5
    assert (shown != before) == bool(moves)
    assert tab.run('document.getElementById("force-box").hidden') == (scene > 0)


def test_answer_comes_first_and_names_the_winner(tab):
    first = tab.run(ROWS)[0][0]
    label = tab.run(f'data.cases.find((design) => design.id === "{first}").label')
    assert text(tab, "sentence").startswith(f"The best design up to 60 g is {label}: ")
    assert tab.run("document.querySelectorAll('img, #static').length") == 0


def test_budgets_in_ounces_stay_in_ounces(chromium, tmp_path):
    table = sweep(6)
    file = write(tmp_path / "trial.h5", table, {"config": "{}"})
    question = Question([1.5 * 28.349523125e-3, 2 * 28.349523125e-3])
    chromium.open(write_page(file, table, question, tmp_path / "trial.html"))
    assert text(chromium, "sentence").startswith("The best design up to 2 oz is ")
    picks = "[...document.querySelectorAll('#budgets button')].map((pick) => pick.textContent)"
    assert chromium.run(picks) == ["1.5 oz", "2 oz"]
    command = chromium.run('document.querySelector("#command code").textContent')
    assert command.endswith('--budget "2 oz"')


@pytest.mark.parametrize(("width", "seen"), [(390, True), (1280, False)])
def test_a_phone_shows_the_whole_scene(chromium, file, width, seen):
    """The end of the text in a narrow list is cut off."""
    chromium.open(file.replace(".h5", ".html"), width, 800)
    put(chromium, "scene", "2", event="change")
    chosen = 'document.getElementById("scene").selectedOptions[0].textContent'
    words = 'document.getElementById("scene-words")'
    assert chromium.run(f"{words}.textContent === {chosen}")
    assert (chromium.run(f"{words}.offsetHeight") > 0) == seen


def test_a_budget_below_the_lightest_design_is_answered(tab):
    put(tab, "budget", "0.5")
    assert tab.run(ROWS) == []
    said = text(tab, "sentence")
    assert said.startswith("No design weighs 0.5 g or less; the lightest weighs ")
    put(tab, "max_force", "60")
    more = text(tab, "detail")
    assert "force at most 60 N." in more
    assert "0 of 0" not in more


def test_requirements_that_nothing_fulfils_are_answered(tab):
    put(tab, "min_absorbed", "1000")
    assert tab.run(ROWS) == []
    assert text(tab, "sentence") == "No design up to 60 g meets the requirements."
    more = text(tab, "detail")
    assert "Required of a specimen: usable energy at least 1000 J." in more
    assert "Nearest: " in more
    put(tab, "budget-on", False, what="checked", event="change")
    assert text(tab, "sentence") == "No design meets the requirements."
    put(tab, "min_absorbed-on", False, what="checked", event="change")
    assert len(tab.run(ROWS)) > 5


def test_what_would_be_needed_is_told_as_in_a_terminal_and_the_nearest_is_drawn(tab, capsys, file):
    put(tab, "min_absorbed", "1000")
    put(tab, "max_force", "60")
    more = text(tab, "detail")
    asked = ["--budget", "60 g", "--min-absorbed", "1 kJ", "--max-force", "60 N"]
    told = " ".join(crumple(capsys, "rank", file, *asked)[1].split())
    needed = "Absorbing 1000 J at no more than 60 N takes a stroke of at least 16667 mm"
    for words in (needed, "the lattice is 12.2 mm high"):
        assert words in told
        assert words in more
    nearest = tab.run("now.nearest.design.id")
    assert f"case {nearest}, " in told
    assert tab.run("document.querySelectorAll('#picture svg').length") == 1
    assert nearest in text(tab, "one-words")
    assert tab.run("document.querySelectorAll('#curves polyline').length") == 1


def test_energy_of_a_crush_that_ended_early_is_a_lower_bound(tab):
    put(tab, "min_absorbed", "1000")
    early = "now.missing.find((row) => row.open && !row.design.crossed)"
    assert "usable energy at least " in tab.run(f"missText({early})")
    late = "now.missing.find((row) => !row.open)"
    assert "at least" not in tab.run(f"missText({late})")


def test_the_lightest_design_above_the_budget_is_told(tab):
    put(tab, "min_absorbed", "1.9")
    put(tab, "budget", "24")
    assert "The lightest design that fulfils this weighs " in text(tab, "detail")


def test_marks_are_those_of_the_terminal(tab, file):
    put(tab, "budget-on", False, what="checked", event="change")
    shown = {case_id: text.lstrip("0123456789=") for case_id, text in tab.run(ROWS)}
    table = rank(file, panel=("100 mm", "50 mm"), by="panel_energy_J", top=None)
    rows = table[table["scene"] == table["scene"].iloc[0]]
    told = rows["pareto"].map({True: "*", False: ""}) + marks(rows)
    assert shown == dict(zip(rows["case_id"], told, strict=True))
    assert any("p" in text for text in shown.values())
    assert any("^" in text for text in shown.values())
    assert "p: does not print as drawn" in text(tab, "notes")


def heads(tab):
    texts = "[...document.querySelectorAll('#table th button')].map((head) => head.textContent)"
    return [text.replace("\n", " ") for text in tab.run(texts)]


def test_stroke_and_deceleration_are_shown_where_the_terminal_shows_them(tab):
    assert "stroke mm" not in heads(tab)
    put(tab, "max_force", "60")
    assert "stroke mm" in heads(tab)
    put(tab, "max_force-on", False, what="checked", event="change")
    put(tab, "force", "20")
    assert heads(tab)[-1] == "stroke mm"
    assert "stroke: over which" in text(tab, "notes")
    put(tab, "scene", "2", event="change")
    assert "stroke mm" not in heads(tab)
    put(tab, "max_deceleration", "900")
    assert heads(tab)[-1] == "decel. g0"


def test_columns_of_the_whole_crush_are_explained(tab):
    notes = text(tab, "notes")
    assert "dens.: densification strain" in notes
    assert "returned: returned energy" in notes
    put(tab, "force", "20")
    assert "dens.: " not in text(tab, "notes")
    put(tab, "scene", "2", event="change")
    notes = text(tab, "notes")
    assert "rebound: energy of the striker" in notes
    assert "All specimens of a panel are struck at once" in notes


@pytest.mark.parametrize("width", [1024, 1280, 1500])
def test_table_is_not_cut_off(chromium, file, width):
    chromium.open(file.replace(".h5", ".html"), width, 900)
    assert heads(chromium)[-2:] == ["dens. %", "returned %"]
    box = "document.querySelector('.wide .scroll')"
    assert chromium.run(f"{box}.scrollWidth - {box}.clientWidth") <= 0


def test_heads_sort_the_rows_without_changing_places(tab):
    before = dict(tab.run(ROWS))
    heads = '[...document.querySelectorAll("#table th button")]'
    click = f"{heads}.find((head) => head.textContent.startsWith('mass')).click()"
    tab.run(click)
    rows = "[...document.querySelectorAll('#table tbody tr')]"
    column = f"({heads}.findIndex((head) => head.textContent.startsWith('mass')) + 1)"
    masses = f"{rows}.map((row) => Number(row.children[{column}].textContent))"
    upwards = tab.run(masses)
    tab.run(click)
    assert upwards == sorted(upwards) != tab.run(masses)
    assert dict(tab.run(ROWS)) == before


def test_a_link_opens_with_the_question_that_was_asked(tab):
    put(tab, "budget", "45.5")
    put(tab, "max_force", "60")
    wait = "new Promise((done) => setTimeout(() => done(location.hash), 600))"
    link, shown = tab.run(wait), tab.run(ROWS)
    put(tab, "budget-on", False, what="checked", event="change")
    tab.run(wait)
    assert tab.run(ROWS) != shown
    tab.run(f"location.hash = {json.dumps(link)}")
    tab.run(wait)
    assert tab.run(ROWS) == shown


def test_on_a_phone_what_is_compared_comes_first(chromium, file):
    chromium.open(file.replace(".h5", ".html"), 390, 900)
    assert heads(chromium)[0] == "#"
    compared = [heads(chromium).index(head) for head in ("J/g", "panel g")]
    assert max(compared) <= 4
    assert chromium.run("document.querySelectorAll('#table tbody svg').length") > 1


def test_a_click_chooses_a_design(tab):
    last = tab.run(ROWS)[-1][0]
    curves = tab.run("document.querySelectorAll('#curves polyline').length")
    tab.run("document.querySelector('#table tbody tr:last-child td:last-child').click()")
    assert last in text(tab, "one-words")
    assert tab.run("document.querySelectorAll('#curves polyline').length") == curves + 1
    assert tab.run("document.querySelectorAll('#book polyline').length") == 3  # two parts, the work


def test_pointer_shows_the_drawing_of_a_design(tab):
    enter = "document.querySelector('.dot').dispatchEvent(new Event('pointerenter'))"
    assert tab.run('document.getElementById("card").hidden') is True
    tab.run(enter)
    assert tab.run('document.querySelectorAll("#card svg path").length') == 1


def test_shapes_move_and_stop(tab):
    points = "document.querySelector('#stage .wall').getAttribute('points')"
    put(tab, "frame", "0")
    at_rest = tab.run(points)
    tab.run("document.getElementById('play').click()")
    wait = "new Promise((done) => setTimeout(() => done(view.frame), 400))"
    assert tab.run(wait) > 0
    assert tab.run(points) != at_rest
    tab.run("document.getElementById('play').click()")
    stopped = tab.run("view.frame")
    assert tab.run(wait) == stopped
    put(tab, "frame", "0")
    assert tab.run(points) == at_rest


def test_drawing_that_is_saved_is_svg_in_millimetres(tab, tmp_path):
    tab.call("Page.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    tab.run("document.getElementById('download').click()")
    saved = tmp_path / tab.run("document.getElementById('download').download")
    for _ in range(100):
        if saved.exists():
            break
        sleep(0.1)
    root = ElementTree.parse(saved).getroot()
    assert (root.get("width"), root.get("height")) == ("11mm", "11mm")
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert saved.name.startswith("_b_trial__b__")


@pytest.mark.parametrize(("width", "dark"), [(390, True), (1280, False)])
def test_page_fits_its_window(chromium, file, width, dark):
    chromium.open(file.replace(".h5", ".html"), width, 800, dark)
    assert chromium.run("document.documentElement.scrollWidth") <= width
    light = chromium.run("getComputedStyle(document.body).backgroundColor").startswith("rgb(251")
    assert light != dark
    assert chromium.complaints == []


def test_tables_stay_where_scripts_do_not_run(chromium, file):
    chromium.call("Emulation.setScriptExecutionDisabled", value=True)
    try:
        chromium.open(file.replace(".h5", ".html"))
        assert chromium.run("document.getElementById('static').offsetHeight") > 100
        assert chromium.run("document.getElementById('app').offsetHeight") == 0
    finally:
        chromium.call("Emulation.setScriptExecutionDisabled", value=False)


def test_page_of_failures_alone_opens(chromium, tmp_path):
    table = summary({"status": "stopped", "message": "no"})
    file = write(tmp_path / "trial.h5", table)
    chromium.open(write_page(file, table, Question(), tmp_path / "trial.html"))
    assert "No case has converged" in chromium.run("document.body.innerText")
    assert chromium.complaints == []
