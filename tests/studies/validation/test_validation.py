"""The reference problems of `make validate`: their errors and observed orders."""

from math import isnan

import pytest

from tests.studies.validation import PROBLEMS, energy
from tests.studies.validation.__main__ import HEAD, row
from tests.studies.validation.elastica import cantilever
from tests.studies.validation.problem import Finding, find
from tests.support import readme

BAND = 0.15


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda problem: problem.name)
def test_problem_is_solved_with_the_order_of_the_method(problem):
    found = find(problem)
    assert found.error < problem.within
    if problem.order:
        assert found.order == pytest.approx(problem.order, abs=BAND)
    (told,) = (cells for cells in readme.table(HEAD[0]) if cells[0] == problem.name)
    shown = row(problem, found)[: len(HEAD)]
    assert readme.words(told) == readme.words(shown)
    *values, _ = readme.numbers(shown)
    assert readme.numbers(told)[: len(values)] == pytest.approx(values, rel=1e-4)
    assert readme.numbers(told) == pytest.approx(readme.numbers(shown), abs=0.02)


def test_every_problem_of_the_readme_is_solved():
    told = [name for name, *_ in readme.table(HEAD[0])]
    assert told == [problem.name for problem in PROBLEMS]


def test_integrators_keep_the_energy_that_the_readme_says():
    shown = readme.table(energy.HEAD[0])
    assert [readme.words(row) for row in shown] == [readme.words(row) for row in energy.rows()]


def test_cantilever_is_that_of_the_literature():
    """Figures of Mattiasson 1981: drop and shortening of the end over L, its slope."""
    assert cantilever(1.0) == pytest.approx((0.30172, 0.05643, 0.46135), abs=1e-5)
    assert cantilever(10.0) == pytest.approx((0.81061, 0.55500, 1.43029), abs=1e-5)


def test_order_and_limit_of_a_sequence():
    found = Finding((1.0 + 16e-3, 1.0 + 4e-3, 1.0 + 1e-3), 1.0, 2.0)
    assert found.order == pytest.approx(2.0)
    assert found.error == pytest.approx(1e-3)
    assert found.extrapolated == pytest.approx(0.0, abs=1e-12)
    assert isnan(Finding((1.0, 1.0, 1.0), 1.0, 2.0).order)
