"""Sentences on cases that a results file lacks."""

import pytest

from sweep.report.tables.missing_notes import incomplete, missing_cases


@pytest.mark.parametrize(
    ("count", "others", "missing"), [(1, 0, 8), (4, 2, 7), (9, 0, 0), (10, 0, 0)]
)
def test_cases_of_the_last_run_are_counted(count, others, missing):
    about = {"asked_cases": 9, "other_cases": others}
    assert missing_cases(count, about) == missing
    start = f"{missing} of 9 cases of the last run are missing"
    assert [line.startswith(start) for line in incomplete(count, about)] == [True] * (missing > 0)


def test_other_parts_may_have_better_designs():
    about = {"asked_cases": 1, "other_cases": 0}
    (one,) = incomplete(1, about | {"part": "1/3"})
    (two,) = incomplete(1, about | {"part": "1/3, 2/3"})
    assert one.startswith("This file has part 1/3 of a sweep: designs of other parts may be better")
    assert two.startswith("This file has parts 1/3, 2/3 of a sweep")
