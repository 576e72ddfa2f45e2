"""The page of a sweep hands out files to print, the same bytes as those of `crumple export`."""

import json
import re
import shlex
from base64 import b64decode
from pathlib import Path

import pytest
from py_mini_racer import MiniRacer

from sweep.config.case import Case
from sweep.export.page import export_page
from sweep.ranking.question import Question
from sweep.report.page import gather
from sweep.result import design_columns
from sweep.store.read import read_summary
from tests.support.command import crumple
from tests.support.results.specimens import summary, write


def crushed(**lattice):
    return Case.of(lattice=lattice, loading={"mode": "displacement"})


CASES = {
    "first": crushed(cells_x=3, cells_y=3),
    "second": crushed(cells_x=4, cells_y=4),
    "period": crushed(cells_x=2, cells_y=2, boundary="periodic"),
    "tied": crushed(cells_x=2, cells_y=2, sides="periodic"),
    "sheet": crushed(kind="gyroid", wall_thickness=0.8e-3, height=12.5e-3),
}
DRAWN = ["first", "second"]


def data_of(page):
    return json.loads(re.search(r'id="data">(.*?)</script>', page.read_text("utf-8"))[1])


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    cases = [*CASES.values()]
    rows = [design_columns(case) | {"case_id": case.case_id} for case in cases]
    return write(tmp_path_factory.mktemp("page") / "own file.h5", summary(*rows), cases=cases)


@pytest.fixture(scope="module")
def data(file):
    page, notes = export_page(file, read_summary(file), Question(), Path(file).with_suffix(".html"))
    assert notes == []
    return data_of(page)


def test_files_of_the_page_are_those_of_the_command(capsys, tmp_path, file, data):
    assert {*data["prints"]} == {CASES[name].case_id for name in DRAWN}
    for case_id, text in data["prints"].items():
        assert crumple(capsys, "export", file, case_id, "--to", str(tmp_path / "a.3mf"))[0] == 0
        assert b64decode(text) == (tmp_path / "a.3mf").read_bytes()


def test_commands_of_the_page_write_a_file(capsys, monkeypatch, file, data):
    """Where there is a part; of every other design there is no command."""
    monkeypatch.chdir(Path(file).parent)
    scripts = [Path(gather.__file__).with_name(name) for name in ("print.js", "plots.js")]
    with MiniRacer() as engine:
        engine.eval("\n".join(script.read_text("utf-8") for script in scripts))
        engine.eval(f"const data = {json.dumps(data)}")
        said = "data.cases.map((design) => exportCommand(design, data.file, null))"
        commands = json.loads(engine.eval(f"JSON.stringify({said})"))
    told = dict(zip((case["id"] for case in data["cases"]), commands, strict=True))
    assert [name for name, case in CASES.items() if told[case.case_id]] == [*DRAWN, "sheet"]
    for command in filter(None, commands):
        Path("best.3mf").unlink(missing_ok=True)
        status, _, err = crumple(capsys, *shlex.split(command)[1:])
        assert (status, err, Path("best.3mf").exists()) == (0, "", True)


def test_as_many_files_as_there_is_room_for(monkeypatch, tmp_path, file, data):
    """The designs that the page begins with come first."""
    sizes = {case_id: len(text) for case_id, text in data["prints"].items()}
    first = next(iter(sizes))
    monkeypatch.setattr(gather, "PRINTS", sum(sizes.values()) - 1)
    page, _ = export_page(file, read_summary(file), Question(), tmp_path / "small.html")
    assert [*data_of(page)["prints"]] == [first]
