"""A fast slice of the study of first designs and effort."""

from types import SimpleNamespace

import pandas as pd
import pytest

from tests.studies.rankings.effort import Grid, compared, drawn, outcome, sheet

SOME = (3, 12)  # grids whose first designs change


def test_no_first_design_changes_without_a_word():
    rows = pd.DataFrame([outcome(number) for number in SOME])
    assert not (rows["iterations"] == "changed").any()
    assert (rows["iterations"] == "named").any(), "no first design changes: the grids say nothing"
    assert rows["iterations_failed"].sum() < 0.1 * rows["failed"].sum()


def ranked(first, coarse=(), others=("a", "b"), named=()):
    """A ranking of ``others``; named: cases that could be first."""
    names = list(others)
    table = {
        "case_id": names,
        "place": [1 if name == first else 2 for name in names],
        "coarse": [name in coarse for name in names],
    }
    unfinished = {"case_id": list(named), "best_place": [1] * len(named)}
    return SimpleNamespace(table=pd.DataFrame(table), unfinished=pd.DataFrame(unfinished))


@pytest.mark.parametrize(
    ("few", "word"),
    [
        (ranked("b"), "same"),
        (ranked("a", named=("b",), others=("a",)), "named"),
        (ranked("a", coarse=("b",)), "marked"),
        (ranked("a", coarse=("a",)), "marked"),
        (ranked("a"), "changed"),
        (
            ranked("a", others=("a",)),
            "changed",
        ),  # the new first design was neither ranked nor named
        (ranked("a", others=()), "nothing ranked"),
    ],
)
def test_what_a_ranking_had_said_of_the_new_first_design(few, word):
    assert compared(few, ranked("b")) == word


def test_grids_are_the_same_each_time_and_not_all_alike():
    assert isinstance(drawn(3), Grid)
    assert drawn(3) == drawn(3) != drawn(4)


def test_the_table_counts_what_became_of_the_first_designs():
    row = {"cases": 3, "failed": 1, "iterations": "same", "steps": "changed"}
    row |= {"iterations_gap": 0.0, "steps_gap": 0.031}
    found = sheet(pd.DataFrame([row, row | {"iterations": "named"}]))
    assert found.rows == [
        ["iterations", "1", "1", "0", "0", "0", "-"],
        ["steps", "0", "0", "0", "2", "0", "3.1"],
    ]
    assert found.notes == ("2 of 6 cases stop with the small effort.",)
