"""The matrix of folded cells in two factors: what is measured is the same system."""

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import splu

from tests.studies.bench import cholmod, folded

CASE = folded.along("square", 1, 0.05, 2)


@pytest.fixture(scope="module")
def ours():
    return folded.Ours(CASE)


def test_the_matrix_that_is_given_to_others_is_ours(ours):
    lower = ours.lower()
    whole = csc_array(lower + lower.T - diags_array(lower.diagonal()))
    b = np.random.default_rng(2).uniform(-1.0, 1.0, lower.shape[0])
    ours.factor()
    expected = splu(whole).solve(b[ours.matrix.unknown])
    np.testing.assert_allclose(ours.solve(b)[ours.matrix.unknown], expected, rtol=1e-6)


def test_cholmod_finds_the_same_solution(ours):
    try:
        peer = cholmod.Peer(ours.lower())
    except ImportError as error:
        pytest.skip(str(error))
    b = np.random.default_rng(3).uniform(-1.0, 1.0, ours.matrix.home.size)
    ours.factor()
    peer.factor()
    found, at = peer.solve(b[ours.matrix.unknown]), ours.matrix.unknown
    np.testing.assert_allclose(found, ours.solve(b)[at], rtol=1e-6)
    with pytest.raises(ArithmeticError, match="not positive definite"):
        cholmod.Peer(-ours.lower()).factor()


def test_rows_are_compared_with_ours_or_say_what_is_missing(monkeypatch):
    def absent():
        raise ImportError("CHOLMOD")

    monkeypatch.setattr(cholmod, "library", absent)
    table = folded.table({"square": CASE}, 1)
    assert table.texts["square", folded.FACTOR].endswith("(1 x)")
    assert table.texts["square, CHOLMOD", folded.UNKNOWNS] == "not installed"
