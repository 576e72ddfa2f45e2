"""Quantities of a question: with units from a user, in SI from the program."""

import numpy as np
import pytest

from sweep.ranking.question import Question, RankError, in_si
from sweep.ranking.rank import rank
from tests.support.results.specimens import summary


def test_text_is_read_in_si_and_numbers_are_in_si_and_above_zero():
    assert in_si("4 oz", "kg") == pytest.approx(0.1134, rel=1e-4)
    assert in_si(0.025, "kg") == 0.025
    with pytest.raises(RankError, match=r"^0 kg: .* must be above zero"):
        in_si(0.0, "kg")


def test_budgets_are_a_list():
    assert Question().budgets == []
    assert Question(budget="25 g").budgets == ["25 g"]
    assert Question(budget=("5 g", 0.02)).budgets == ["5 g", 0.02]


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ({"budget": "0 g"}, r"^0 g: .* must be above zero"),
        ({"budget": 25}, 'budget = 25: a bare number; allowed: text with a unit, such as "25 g"'),
        ({"budget": ["2 g", 0.01]}, "budget = 0.01: a bare number"),
        ({"budget": np.float64(2.0)}, "a bare number"),
        ({"panel": ("0.1 m",)}, r"panel = .*; allowed: two lengths, such as"),
        ({"panel": ("1 m", 0.1)}, 'panel = 0.1: a bare number; .* "100 mm"'),
        ({"budget": "25"}, '"25": a bare number; allowed: a mass with a unit, such as "25 g"'),
        ({"panel": "100 mm"}, r"^panel = '100 mm'; allowed: two lengths, such as"),
        ({"allowed_force": 50.0}, 'allowed_force = 50.0: a bare number; .* "50 N"'),
    ],
)
def test_number_without_a_unit_is_refused(asked, told):
    with pytest.raises(RankError, match=told):
        rank(summary({}), **asked)
