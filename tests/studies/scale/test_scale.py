"""A fast slice of the study of many cases: invented results through every verb, and its table."""

import json
import re

import pytest

from sweep.config.load import load_config
from sweep.ranking.curves import reached
from sweep.running.sweep import run_sweep
from sweep.store.read import read_history, read_summary
from tests.studies.scale import __main__ as study
from tests.studies.scale.invented import FORCES, OF_A_DEPTH, invent, write_config
from tests.studies.scale.measure import measured
from tests.support.command import crumple

PART = slice(None, None, 2)  # of a thousand cases


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the results of 500 cases, the config of a thousand, and a page."""
    folder = tmp_path_factory.mktemp("scale")
    cases = load_config(write_config(folder, OF_A_DEPTH)).cases[PART]
    run_sweep(cases, folder / "scale.h5", 1, simulate=invent)
    return folder


def test_invented_columns_are_those_of_their_curves(folder):
    summary = read_summary(folder / "scale.h5")
    assert 0 < (summary["status"] == "stopped").sum() < 0.05 * len(summary)
    for _, row in summary[::100].iterrows():
        history = read_history(folder / "scale.h5", row["case_id"])
        for force in FORCES:
            energy = row[f"absorbed_energy_at_{force:g}N_J"]
            assert reached(history, force)[0] == pytest.approx(energy, rel=1e-5)


def test_resume_of_a_half_and_of_a_whole_sweep_runs_what_is_missing(folder, tmp_path):
    """Cases and their order are the same as in the config."""
    cases = load_config(write_config(tmp_path, OF_A_DEPTH)).cases[:200]
    ran = []

    def watched(case, _):
        ran.append(case.case_id)
        return invent(case)

    for part in (cases[::4], cases, cases):
        run_sweep(part, tmp_path / "scale.h5", 1, simulate=watched)
    assert sorted(ran) == sorted(case.case_id for case in cases)
    assert list(read_summary(tmp_path / "scale.h5")["case_id"]) == [c.case_id for c in cases]


def test_page_of_many_cases_holds_some_and_says_so(folder, capsys):
    status, _, _ = crumple(capsys, "report", str(folder / "scale.h5"))
    html = (folder / "scale.html").read_text("utf-8")
    assert (status, len(html) < 5e6) == (1, True)
    data = json.loads(re.search(r'id="data">(.*?)</script>', html)[1])
    (scene,) = data["scenes"]
    assert len(data["cases"]) == 300 < scene["designs"]
    assert f"The page holds 300 of {scene['designs']} designs" in html
    assert sum(map(len, scene["others"])) > 100


def test_verb_is_measured_in_a_process_of_its_own(folder):
    told = measured(folder, "status")
    assert 0.1 < told["cpu_s"] < 60.0
    assert 50.0 < told["peak_MB"] < 1000.0


def test_table_has_a_row_for_every_verb(tmp_path, monkeypatch):
    def made_up(folder, _):
        (folder / "scale.html").write_text("a" * 2_000_000)
        (folder / "scale.h5").write_text("a" * 3_000_000)
        return {"cpu_s": 1.234, "wall_s": 2.0, "peak_MB": 345.6}

    monkeypatch.setattr(study, "measured", made_up)
    sheet = study.sheet(tmp_path / "20", 2000)
    assert sheet.rows[0] == ["expand", "1.23", "2", "346"]
    assert sheet.rows[-2:] == [[study.PAGE, "", "", "2"], [study.FILE, "", "", "3"]]
    assert len(sheet.rows) == len(study.ACTIONS) + 2
