"""Sentences on cases that stopped: each is named once, with its place and its reason."""

from functools import partial

from sweep.ranking.rank import ranked
from sweep.report.tables.design_text import named_case
from sweep.report.tables.unfinished_notes import MOST, each_once, picture_note, unfinished_notes
from tests.support.results.specimens import designs, summary

WHY = {"status": "stopped", "message": "it diverged while loading, at strain 0.2; why"}


def table(stopped):
    """Two designs, and this many that stopped with 0.2 J, of other walls."""
    walls = [{"wall_thickness_m": (k + 2) * 1e-4, "absorbed_energy_J": 0.2} for k in range(stopped)]
    return summary(*designs([1.0, 2.0], [0.1, 0.5]), *(WHY | wall for wall in walls))


def notes(stopped, **question):
    summed = table(stopped)
    rows = ranked(summed, **question).unfinished
    return list(unfinished_notes(rows, partial(named_case, among=summed)))


def test_a_case_is_named_with_its_design_its_place_and_its_reason():
    (line,) = notes(1)
    words = " ".join(line.split())
    assert "case 0000000000000002, wall 0.2 mm" in words
    assert "would have place 2 or better" in words
    assert words.endswith(f"{WHY['message']}.")


def test_of_several_budgets_the_best_place_counts():
    rows = ranked(table(1), budget=["1 g", "9 g"]).unfinished
    assert len(rows) == 2
    assert list(each_once(rows)["budget_g"]) == [1.0]
    assert "place 1 up to 1 g" in " ".join(notes(1, budget=["1 g", "9 g"])[0].split())


def test_no_more_than_a_few_are_named():
    lines = notes(MOST + 3)
    assert len(lines) == MOST + 1
    assert lines[-1].startswith("3 more")


def test_a_picture_names_them_too():
    assert "wall 0.2 mm: would have place 2 or better" in picture_note(ranked(table(1)))
    assert picture_note(ranked(table(0))) == ""
