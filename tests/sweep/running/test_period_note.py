"""A run says in which cases one period represents a wide panel, and whether it keeps its width."""

import pytest

from sweep.config.case import Case
from sweep.ranking.merit import check_panel
from sweep.ranking.question import RankError
from sweep.running.period_note import sentences_on_periods


def tied(friction):
    return Case.of(
        lattice={"sides": "periodic"},
        loading={"strain": 0.5, "platen": "contact"},
        contact={"friction": friction},
    )


def test_fixed_and_free_periods_are_told_apart():
    others = [Case.of(), tied(0.3), tied(0.0), tied(0.4)]
    fixed, free = sentences_on_periods(others)
    assert fixed.startswith("2 of 4 cases are one period of a wide panel")
    assert "its width is fixed" in fixed
    assert free.startswith("1 of 4 cases")
    assert "its width is free" in free
    assert sentences_on_periods([Case.of()]) == []


def test_periods_fill_a_panel_of_any_size():
    check_panel(("1 mm", "1 mm"), [tied(0.3)])
    with pytest.raises(RankError, match="smaller than half of a specimen"):
        check_panel(("1 mm", "1 mm"), [Case.of(), tied(0.3)])
