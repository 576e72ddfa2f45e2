"""A fast slice of the study of damaged files, killed runs, workers and schedulers."""

import sys
from collections import Counter
from contextlib import nullcontext
from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest
from pandas import DataFrame

from tests.studies.torture import clusters, damage, fuzz, kills, lock, poison
from tests.studies.torture.reader import Reader
from tests.support.results.standin import cases, write


def test_few_damages_are_told_or_harmless(tmp_path):
    write(tmp_path / "armor.h5", cases(4), fold=True)
    counts = damage.damage(tmp_path / "armor.h5", 4)
    assert damage.is_sound(counts)
    assert sum(found[damage.TOLD] for found in counts.values()) > 8
    assert [row[0] for row in damage.sheet(counts).rows] == list(damage.KINDS)


def in_this_process(function, *_):
    """In place of a `Reader`, without its process."""
    return nullcontext(SimpleNamespace(outcome=function))


def test_few_damages_of_a_part_are_told_or_harmless(tmp_path, monkeypatch):
    monkeypatch.setattr(damage, "Reader", in_this_process)
    write(tmp_path / "armor.h5", cases(4), fold=True)
    counts = damage.damage_part(tmp_path / "armor.h5", tmp_path, 4)
    assert damage.is_sound(counts)
    assert sum(found[damage.TOLD] for found in counts.values()) > 8
    assert not (tmp_path / "damaged.h5").exists()


def test_what_is_silently_other_is_found(tmp_path):
    write(tmp_path / "one.h5", cases(2), fold=True)
    write(tmp_path / "other.h5", cases(3), fold=True)
    assert damage.outcome(tmp_path / "other.h5", damage.everything(tmp_path / "one.h5")) == (
        damage.SILENT
    )
    assert not damage.is_sound({"a bit flipped": Counter({damage.SILENT: 1})})


def test_a_reader_that_gives_no_answer_is_given_up(tmp_path):
    with Reader(damage.outcome, 0.0, damage.SILENCE) as reader:
        assert reader.outcome(tmp_path / "none.h5", "") == damage.SILENCE


def test_few_mutated_inputs_are_used_or_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(fuzz, "Reader", in_this_process)
    write(tmp_path / "armor.h5", cases(4), fold=True)
    counts = fuzz.fuzz(tmp_path, tmp_path / "armor.h5", 20, pytest.fail)
    assert fuzz.is_sound(counts)
    assert sum(each[fuzz.REFUSED] for each in counts.values()) > 6
    assert sum(each[fuzz.USED] for each in counts.values()) > 2
    assert [row[0] for row in fuzz.sheet(counts).rows] == [*counts]


def test_inputs_can_be_used_before_they_are_mutated(tmp_path):
    write(tmp_path / "armor.h5", cases(4), fold=True)
    for seeds in fuzz.inputs(tmp_path / "armor.h5").values():
        given = seeds[0]
        (tmp_path / given.name).write_bytes(given.content)
        if given.beside:
            (tmp_path / given.beside[0]).write_text(given.beside[1], "utf-8")
        assert fuzz.outcome(tmp_path, given.words) == fuzz.USED


def test_what_may_not_be_said_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr(fuzz, "main", lambda words: {}["a traceback"])
    assert fuzz.outcome(tmp_path, ("run",)) == fuzz.RAISED
    monkeypatch.setattr(fuzz, "main", lambda words: sys.stderr.write("line\n" * 13))
    assert fuzz.outcome(tmp_path, ("run",)) == fuzz.LONG
    assert not fuzz.is_sound({"configs": Counter({fuzz.SLOW: 1})})


def test_kills_lose_nothing(tmp_path, monkeypatch):
    """In place of a command: two cases more in its file, and every third time its end."""
    numbers = count()

    def kill(*_):
        number = next(numbers)
        write(tmp_path / "killed.h5", cases(2, 2 * number))
        return number % 3 < 2

    monkeypatch.setattr(kills, "kill", kill)
    found = kills.torture(tmp_path, "run", 3)
    assert found == kills.Killed(3, 0, 0, 1)
    assert [*kills.rows(tmp_path)] == ["killed.h5"]
    assert kills.sheet({"run": found}).rows == [["run", "3", "0", "0", "1"]]


def test_a_command_is_killed_unless_it_has_ended():
    rng = np.random.default_rng(1)
    assert kills.kill(["sleep", "60"], 0.1, rng)
    assert not kills.kill(["true"], 0.5, rng)


def test_what_is_lost_or_computed_twice_is_counted():
    before, after = (
        DataFrame({"cpu_s": t}, [*ids]) for t, ids in (([1, 2, 3], "abc"), ([1, 5], "ab"))
    )
    assert kills.difference({"a.h5": before}, {"a.h5": after}) == (1, 1)
    assert kills.difference({"a.h5": before}, {}) == (3, 0)


def test_a_killed_worker_costs_no_row(tmp_path, monkeypatch):
    monkeypatch.setattr(clusters, "LONGEST", 0.2)
    monkeypatch.setattr(clusters, "WORKERS", 1)
    found = clusters.torture(tmp_path, 1, schedulers=0, count=3)
    assert found._replace(refused=0) == clusters.Killed(1, 0, 0, 0, 0, 0)
    assert clusters.sheet(found._replace(refused=2)).rows == [["1", "0", "0", "0", "0", "2"]]


def test_refusals_are_heard():
    """Workers with another source count as refused; a worker that cannot run Crumple at all does
    not.
    """
    said = "worker other (tcp://127.0.0.1:1) is refused: it has source ab (this run: cd)"
    assert clusters.REFUSED.search(said)
    assert not clusters.REFUSED.search(said.replace("has source ab", "cannot run Crumple"))


def test_the_lock_is_held_for_a_part_of_a_case():
    found = lock.held("smoke", 2)
    assert 0.0 < found.lock < found.case
    (row,) = lock.sheet({"smoke": lock.Held(0.05, 0.005)}).rows
    assert row == ["smoke", "50", "5", "10", "10"]


@pytest.mark.parametrize("place", poison.PLACES)
def test_poisoned_cases_are_named_and_the_others_are_kept(tmp_path, place):
    found = poison.torture(tmp_path, place, 9)
    assert poison.is_sound({place: found})
    assert found.cases == 9 - (place != "processes")
    assert poison.sheet({place: found}).rows[0][:4] == [place, str(found.cases), "0", "0"]


def test_a_poisoned_case_with_another_end_is_found():
    assert poison.is_right(poison.DEADLY, "worker_died", "its process died")
    assert not poison.is_right(poison.DEADLY, "converged", "")
    assert not poison.is_right(poison.LARGE, "stopped", "no equilibrium")
    assert not poison.is_right(poison.DEADLY - 1, "worker_died", "")
    assert not poison.is_sound({"threads": poison.Poisoned(12, 1, 0, 1.0)})
    assert not poison.is_sound({"threads": poison.Poisoned(12, 0, 1, 1.0)})
