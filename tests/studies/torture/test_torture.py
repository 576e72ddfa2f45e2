"""A fast slice of the study of damaged files, killed runs, workers and schedulers."""

from collections import Counter

from tests.studies.torture import clusters, damage, kills
from tests.support.results.standin import cases, write


def test_few_damages_are_told_or_harmless(tmp_path):
    write(tmp_path / "armor.h5", cases(4), fold=True)
    counts = damage.damage(tmp_path / "armor.h5", 6)
    assert damage.is_sound(counts)
    assert sum(found[damage.TOLD] for found in counts.values()) > 12
    assert [row[0] for row in damage.sheet(counts).rows] == list(damage.KINDS)


def test_what_is_silently_other_is_found(tmp_path):
    write(tmp_path / "one.h5", cases(2), fold=True)
    write(tmp_path / "other.h5", cases(3), fold=True)
    assert damage.outcome(tmp_path / "other.h5", damage.everything(tmp_path / "one.h5")) == (
        damage.SILENT
    )
    assert not damage.is_sound({"a bit flipped": Counter({damage.SILENT: 1})})


def test_a_reader_that_gives_no_answer_is_given_up(tmp_path, monkeypatch):
    monkeypatch.setattr(damage, "PATIENCE", 0.0)
    with damage.Reader() as reader:
        assert reader.outcome(tmp_path / "none.h5", "") == damage.SILENCE


def test_two_kills_lose_nothing(tmp_path):
    found = kills.torture(tmp_path, 2, longest=3.0)
    assert found == kills.Killed(2, 0, 0)
    assert kills.sheet(found).rows == [["2", "0", "0"]]


def test_a_killed_worker_costs_no_row(tmp_path):
    found = clusters.torture(tmp_path, 1, schedulers=0, count=3)
    assert found == clusters.Killed(1, 0, 0, 0, 0)
    assert clusters.sheet(found).rows == [["1", "0", "0", "0", "0"]]
