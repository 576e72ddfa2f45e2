"""Sentences on cases that stopped: each is named once, with its place."""

from functools import partial

from sweep.ranking.rank import ranked
from sweep.report.tables.design_text import named_case
from sweep.report.tables.unfinished_notes import MOST, picture_note, unfinished_notes
from tests.support.results.specimens import designs, summary


def table(stopped):
    why = {"status": "stopped", "message": "why", "absorbed_energy_J": 0.2}
    walls = [why | {"wall_thickness_m": (k + 2) * 1e-4} for k in range(stopped)]
    return summary(*designs([1.0, 2.0], [0.1, 0.5]), *walls)


def test_of_several_budgets_the_best_place_counts_and_no_more_than_a_few_are_named():
    stopped = table(MOST + 3)
    rows = ranked(stopped, budget=["1 g", "9 g"]).unfinished
    lines = list(unfinished_notes(rows, partial(named_case, among=stopped)))
    assert len(lines) == MOST + 1
    assert "case 0000000000000002, wall 0.2 mm: would have place 1 up to 1 g" in lines[0]
    assert lines[-1].startswith("3 more")


def test_a_picture_names_them_too():
    assert "wall 0.2 mm: would have place 2 or better" in picture_note(ranked(table(1)))
    assert picture_note(ranked(table(0))) == ""
