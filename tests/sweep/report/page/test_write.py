"""The page as a file: whole, safe from names, small, and without a network or scripts."""

import json
import re
from base64 import b64encode
from hashlib import sha256
from html.parser import HTMLParser

import pytest

from sweep.ranking.question import Question
from sweep.ranking.rank import rank
from sweep.report.page.gather import first_ranking, page_data
from sweep.report.page.write import page, tables, write_page
from tests.support.command import crumple
from tests.support.results.page_data import sweep
from tests.support.results.specimens import designs, ids, summary, write

EVIL = '<script>alert("&")</script>'
VOID = {"meta", "input", "br", "link", "img"}


class Reader(HTMLParser):
    """Collects elements, and reports elements that are not closed in their order."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.elements, self.text, self.wrong = [], [], {}, []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        """An element begins."""
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        """An element ends."""
        if not self.open or self.open.pop() != tag:
            self.wrong.append((tag, self.getpos()))

    def handle_data(self, data):
        """Text of the innermost element."""
        where = self.open[-1] if self.open else ""
        self.text[where] = self.text.get(where, "") + data


def written(path, table, **question):
    file = write(path / "trial.h5", table, {"config": json.dumps({"name": EVIL, "rank": {}})})
    made = write_page(file, table, Question(**question), path / "out" / "trial.html")
    return made.read_text("utf-8")


def data_of(html):
    return json.loads(re.search(r'id="data">(.*?)</script>', html)[1])


@pytest.fixture(scope="module")
def evil(tmp_path_factory):
    """A page in which every name, and the sentence of a failure, is a script."""
    failed = {"status": "stopped", "message": f"stopped: {EVIL}"}
    rows = designs([1.0, 2.0], [0.1, 0.3], material=EVIL)
    table = summary(*rows, {"lattice_kind": EVIL} | failed)
    return written(tmp_path_factory.mktemp("evil"), table)


def test_elements_are_closed_in_their_order(evil):
    read = Reader(evil)
    assert (read.wrong, read.open) == ([], [])
    ids = [attributes["id"] for _, attributes in read.elements if "id" in attributes]
    assert len(ids) == len({*ids}) > 30


def test_names_from_files_are_text(evil):
    read = Reader(evil)
    assert [tag for tag, _ in read.elements].count("script") == 2
    assert EVIL not in evil
    assert f"stopped: {EVIL}" in read.text["td"]
    assert f"{EVIL}: which lattice is best?" in read.text["h1"]
    data = data_of(evil)
    assert data["name"] == EVIL
    assert {case["text"][-1] for case in data["cases"]} == {EVIL}


def test_nothing_is_loaded_from_elsewhere(evil):
    read = Reader(evil)
    addresses = [a for _, known in read.elements for a in ("src", "href", "action") if a in known]
    assert addresses == []
    assert "default-src 'none'" in evil
    assert not re.search(r"url\(|@import|fetch\(|https?://(?!www\.w3\.org)", evil)


def test_only_the_program_may_run(evil):
    program = re.findall(r"<script>(.*?)</script>", evil, re.DOTALL)
    digest = b64encode(sha256(program[0].encode()).digest()).decode()
    assert len(program) == 1
    assert f"script-src 'sha256-{digest}'" in evil


def test_tables_are_readable_without_scripts(tmp_path):
    table = summary(*designs([1.0, 2.0, 4.0], [0.1, 0.3, 0.4]))
    text = tables(table, first_ranking(table, Question(budget=[0.002, 0.004])))
    read = Reader(text)
    assert "The best design up to 2 g, crushed to 50 %, glued platens" in read.text["p"]
    assert [tag for tag, _ in read.elements].count("tr") == 6
    assert "Pareto front" in read.text["p"]
    assert text in written(tmp_path, table, budget=[0.002, 0.004])


def test_a_page_of_a_part_says_that_other_designs_may_be_better(tmp_path):
    file = write(tmp_path / "trial.h5", summary({}), {"config": "{}", "part": "1/3"})
    made = write_page(file, summary({}), Question(), tmp_path / "trial.html")
    header = made.read_text("utf-8").partition("</header>")[0]
    assert "This file has part 1/3 of a sweep: designs of other parts may be better" in header
    assert "of the last run are missing" not in header


def test_tables_have_only_what_is_required():
    table = summary(*designs([1.0, 2.0, 4.0], [0.1, 0.3, 0.4]))
    question = Question(require={"max_mass": 2.5e-3, "min_absorbed": 0.2})
    read = Reader(tables(table, first_ranking(table, question)))
    assert "usable energy at least 200 mJ" in read.text["p"]
    assert "1 of 3 designs fulfil this" in " ".join(read.text["p"].split())
    assert [tag for tag, _ in read.elements].count("tr") == 2


def test_tables_are_sorted_as_rank_sorts_without_a_budget(tmp_path, capsys):
    """The lightest absorbs most per gram, the heaviest most in all."""
    table = summary(*designs([1.0, 2.0, 4.0], [0.2, 0.3, 0.4]))
    file = write(tmp_path / "trial.h5", table, {"config": '{"rank": {"budgets": []}}'})
    crumple(capsys, "report", file)
    static = (tmp_path / "trial.html").read_text("utf-8").partition('<div id="app"')[0]
    masses = re.findall(r"<tr><td>\d[^<]*</td><td>([^<]+)</td>", static)
    assert masses == ["1.00", "2.00", "4.00"]
    assert ids(rank(file)) == [0, 1, 2]


def test_failures_are_counted_with_their_sentences(tmp_path):
    why = {"status": "stopped", "message": "stopped at strain 0.5: more solver.load_steps"}
    alone = written(tmp_path, summary(why))
    assert ("No case has converged" in alone, "1 case failed" in alone) == (True, True)
    assert Reader(alone).wrong == []
    text = written(tmp_path, summary({}, why, why))
    assert "3 cases, 2 of them failed" in text
    assert text.count(f"<td>{why['message']}</td>") == 2


def test_page_tells_where_its_numbers_come_from(tmp_path):
    about = {"config": '{"name": "mine", "depth": 0.0123}', "git_revision": "abc", "created": "now"}
    file = write(tmp_path / "trial.h5", summary({}), about | {"version_numpy": "9.9"})
    read = Reader(page(page_data(file, summary({}), Question()), ""))
    assert all(word in read.text["dd"] for word in ("trial.h5", "abc", "now", "9.9"))
    assert '"depth": 0.0123' in read.text["pre"]


def test_periods_fill_a_panel_without_gaps_and_slicer_settings_are_shown(tmp_path):
    more = {"sides": "tied, fixed", "slicer_settings": "PrusaSlicer: Grid, 15 %"}
    html = written(tmp_path, sweep(6, more=more))
    cases = data_of(html)["cases"]
    assert {design["gap"] for design in cases} == {None}
    assert all(design["outer"][0] > 0.0 for design in cases)
    assert "PrusaSlicer: Grid, 15 %" in html


def test_verb_writes_the_page_beside_the_file(capsys, tmp_path):
    question = {"min_absorbed": 2.0, "max_force": None}
    config = {"rank": {"budgets": [0.002], "panel": [0.1, 0.05], "per": "panel"}, "name": "mine"}
    about = {"config": json.dumps(config | {"require": question})}
    file, made = write(tmp_path / "trial.h5", summary({}), about), tmp_path / "trial.html"
    status, out, _ = crumple(capsys, "report", file)
    assert (status, out.split()[0]) == (0, str(made))
    assert data_of(made.read_text("utf-8"))["question"] == {
        "budgets_g": [2.0],
        "panel": [0.1, 0.05],
        "require": {"min_absorbed": 2.0},
        "per": "panel",
    }
    assert {path.name for path in tmp_path.iterdir()} == {"trial.h5", "trial.html"}
    status, out, _ = crumple(capsys, "report", file, "--out", str(tmp_path / "new" / "a.html"))
    assert (status, (tmp_path / "new" / "a.html").exists()) == (0, True)


@pytest.mark.parametrize("name", ["a.txt", "", "folder.html", "trial.h5/a.html"])
def test_page_needs_a_place(capsys, tmp_path, name):
    file = write(tmp_path / "trial.h5", summary({}))
    (tmp_path / "folder.html").mkdir()
    out = str(tmp_path / name) if name else name
    status, _, err = crumple(capsys, "report", file, "--out", out)
    assert status == 2
    assert err.startswith("crumple report: ")
    assert err.count("\n") <= 2


def test_failures_give_status_one(capsys, tmp_path):
    file = write(tmp_path / "trial.h5", summary({}, {"status": "stopped", "message": "no"}))
    status, _, err = crumple(capsys, "report", file)
    assert (status, err) == (1, "1 of 2 cases failed: the page lists them\n")
