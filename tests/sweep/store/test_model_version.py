"""Rows of several versions of the model in one file: each says which, and what it was run with."""

from math import nan

import h5py
import numpy as np
import pytest

from sweep.columns import COLUMNS, OLDER
from sweep.result import MODEL_VERSION
from sweep.store.read import read_summary
from tests.support.results.standin import cases, write, write_older

FIRST = 51  # columns of a summary that every file has


@pytest.fixture
def path(tmp_path):
    return tmp_path / "sweep.h5"


def columns(path, batch):
    """Version and revision of each case."""
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


@pytest.mark.parametrize("fold", [False, True])
def test_rows_from_before_there_was_a_version_are_of_the_first(path, fold):
    write_older(path, cases(3), git_revision="lost")
    assert columns(path, cases(3)) == ([1] * 3, [""] * 3)
    write(path, cases(2, first=3), fold, git_revision="b2")
    assert columns(path, cases(5)) == ([1] * 3 + [MODEL_VERSION] * 2, [""] * 3 + ["b2"] * 2)
    assert MODEL_VERSION > 1


@pytest.mark.parametrize(("value", "read"), [(nan, [nan] * 3), ("", [""] * 3), (1, [1] * 3)])
def test_a_column_that_a_file_is_too_old_for_is_read_as_told(path, value, read, monkeypatch):
    write(path, cases(3), True)
    monkeypatch.setitem(OLDER, "new", value)
    found = read_summary(path)["new"]
    np.testing.assert_array_equal(found.to_numpy(), read)
    assert found.dtype.kind == {float: "f", str: "O", int: "i"}[type(value)]


def test_a_new_column_is_told_of_older_files():
    """Those of the first files are as many; a file without a later one is ranked all the same."""
    assert len({*COLUMNS} - {*OLDER}) == FIRST


def test_columns_say_what_they_are(path):
    write(path, cases(1), fold=True)
    with h5py.File(path) as file:
        said = {name: file["summary"][name].attrs["description"] for name in OLDER}
    assert "version of the model" in said["model_version"]
    assert "commit of the source" in said["git_revision"]
