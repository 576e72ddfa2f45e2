"""Rows of several versions of the model in one file: each says which, and what it was run with."""

import pytest

from sweep.columns import COLUMNS
from sweep.result import MODEL_VERSION
from sweep.store.batch import FORMAT
from sweep.store.read import read_summary
from tests.support.results.standin import cases, write


def columns(path, batch):
    table = read_summary(path).set_index("case_id").loc[[case.case_id for case in batch]]
    assert table["model_version"].dtype.kind == "i"
    return list(table["model_version"]), list(table["git_revision"])


@pytest.mark.parametrize("fold", [False, True])
def test_a_row_keeps_the_version_and_the_revision_that_it_was_run_with(path, fold):
    write(path, cases(3), fold, git_revision="a1")
    write(path, cases(2, first=3), fold, git_revision="b2-dirty")
    versions, revisions = columns(path, cases(5))
    assert revisions == ["a1"] * 3 + ["b2-dirty"] * 2
    assert set(versions) == {MODEL_VERSION}
    write(path, cases(1), fold, git_revision="c3")
    assert columns(path, cases(5))[1] == ["c3", "a1", "a1", "b2-dirty", "b2-dirty"]


def test_a_new_column_is_a_new_format():
    """Files without it are refused: every row has all columns."""
    assert (FORMAT, len(COLUMNS)) == (10, 108)
