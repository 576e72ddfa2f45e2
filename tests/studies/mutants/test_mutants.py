"""The study of mutants: it tells who notices, and does not rot."""

import pytest

from tests.studies.mutants.__main__ import main, sheet
from tests.studies.mutants.changes import MUTANTS
from tests.studies.mutants.trial import ROOT, Copy, StudyError, Verdict, check, mutated

ENERGY = next(mutant for mutant in MUTANTS if mutant.name == "inertia: energy")
KILLED = Verdict(ENERGY, "tests/test_it.py::test_it", 1.25, False)
SURVIVES = Verdict(ENERGY, None, 60.0, True)


def test_every_snippet_is_found_exactly_once():
    check(MUTANTS)
    assert len({mutant.name for mutant in MUTANTS}) == len(MUTANTS)


@pytest.mark.parametrize(("source", "found"), [("", 0), ("total += force, total += force", 2)])
def test_a_snippet_that_is_gone_or_not_alone_is_told(source, found):
    with pytest.raises(StudyError, match=rf"{ENERGY.path} has {found} x .*; it must be there once"):
        mutated(source, ENERGY)


def test_a_mutant_turns_a_test_red_in_a_copy(tmp_path):
    source = (ROOT / ENERGY.path).read_text("utf-8")
    copy = Copy(tmp_path / "copy")
    verdict = copy.tried(ENERGY)
    assert verdict.red.startswith("tests/kernels/terms/test_inertia.py::test_derivatives[")
    assert not verdict.compiled
    assert (copy.folder / ENERGY.path).read_text("utf-8") == source
    assert (ROOT / ENERGY.path).read_text("utf-8") == source


def test_a_test_that_is_red_anyway_kills_nothing(tmp_path):
    copy = Copy(tmp_path / "copy")
    path = copy.folder / ENERGY.path
    path.write_text(mutated(path.read_text("utf-8"), ENERGY), "utf-8")
    gradient = ENERGY._replace(snippet="g[i] += force", wrong="g[i] -= force")
    with pytest.raises(StudyError, match="is red without a mutant too"):
        copy.tried(gradient)


def test_the_table_has_survivors_first():
    table = sheet([KILLED, SURVIVES])
    assert table.columns[2] == ["none: it survives", "tests/test_it.py::test_it"]
    assert table.columns[3] == ["60.0", "1.2"]
    assert table.notes == ("1 of 2 turn a test red.",)


@pytest.mark.parametrize(("verdict", "failed"), [(KILLED, False), (SURVIVES, True)])
def test_a_survivor_is_a_failure(verdict, failed, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("tests.studies.mutants.__main__.tried", lambda mutants: [verdict])
    assert main(tmp_path / "mutants") == failed
    told = capsys.readouterr().out
    assert ENERGY.name in told
    assert (tmp_path / "mutants" / "mutants.md").read_text("utf-8") == told
