"""Cases that a config computed before it was edited: kept, counted and reported."""

from pathlib import Path

import pytest

from sweep.__main__ import main
from sweep.running.sweep import run_sweep
from sweep.store.read import read_attributes
from sweep.store.write import Writer
from tests.conftest import CONFIG
from tests.support.results.standin import cases, simulate

MISSING = "of the", "cases of the", "of 5 cases of the"


def test_cases_of_other_configs_are_counted_anew_by_every_run(tmp_path):
    out = tmp_path / "sweep.h5"
    for asked, others in ((6, 0), (9, 0), (4, 5), (4, 5), (9, 0)):
        run_sweep(cases(asked), out, simulate=simulate)
        assert read_attributes(out)["other_cases"] == others


def test_an_edited_question_is_stored_although_no_case_is_missing(config, capsys):
    grid = CONFIG.format(values=[0.1]).partition("[rank]")[0]
    for limit in ("1 g", "2 g"):
        Path(config).write_text(f'{grid}[require]\nmax_mass = "{limit}"\n')
        assert main(["run", config]) == 0
        capsys.readouterr()
        main(["rank", "results/trial.h5"])
        assert f"mass at most {limit}" in capsys.readouterr().out
    stored = Path("results/trial.h5").stat().st_mtime_ns
    assert main(["run", config]) == 0
    assert Path("results/trial.h5").stat().st_mtime_ns == stored


@pytest.mark.parametrize("verb", ["run", "rank", "status"])
def test_other_configs_are_told_of(config, capsys, verb):
    for values, others in (([0.1, 0.2, 0.3], ""), ([0.3, 0.4], "2 of 4 cases belong to other")):
        Path(config).write_text(CONFIG.format(values=values))
        assert main(["run", config]) == 0
        if verb != "run":
            capsys.readouterr()
            main([verb, "results/trial.h5"])
        told = capsys.readouterr().out
        if verb == "status":
            others = others and "2 cases belong to other configs than the last run"
        assert ("other configs" in told) == bool(others)
        assert others in told


@pytest.mark.parametrize("verb", ["rank", "status", "report"])
def test_cases_that_an_interrupted_run_left_out_are_counted(tmp_path, capsys, verb):
    path, whole = tmp_path / "trial.h5", cases(5)
    with Writer(path, {case.case_id: case.axes for case in whole}) as writer:
        writer.append([simulate(case) for case in whole[:3]])
    assert read_attributes(path)["other_cases"] == 0
    main([verb, str(path)])
    output = "".join(capsys.readouterr())
    assert any(f"2 {words} last run are missing" in output for words in MISSING)
    with Writer(path, {case.case_id: case.axes for case in whole}) as writer:
        writer.append([simulate(case) for case in whole[3:]])
    main([verb, str(path)])
    assert "missing" not in "".join(capsys.readouterr())
