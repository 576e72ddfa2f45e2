"""Energy and stroke up to a force of a panel, from stored curves."""

import numpy as np
import pytest

from sweep.ranking.curves import reached, with_allowed
from sweep.ranking.merit import AT_ALLOWED, RankError
from sweep.ranking.question import Question
from sweep.ranking.rank import rank
from sweep.store.read import read_history, read_summary
from tests.support.results.specimens import designs, ids, summary, write

PANEL = ("130 mm", "50 mm")


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """Three crushes, one of a specimen twice as wide, and one that failed; all curves come from
    `there_and_back`: 20 N + 2 N/mm over 4 mm.
    """
    rows = designs([1.0, 2.0, 3.0, 4.0], [0.1, 0.1, 0.1, 0.1])
    rows[1]["outer_width_m"] = 26e-3
    rows[3]["status"] = "stopped"
    return write(tmp_path_factory.mktemp("curves") / "trial.h5", summary(*rows))


def test_a_curve_answers_for_any_force(file):
    table = read_summary(file)
    first = read_history(file, table["case_id"][0])
    assert reached(first, 24.0) == pytest.approx((44e-3, 2e-3))
    assert reached(first, 1e3) == pytest.approx((96e-3, 4e-3))
    strokes = with_allowed(file, table, Question(allowed_force=24.0))["stroke_at_allowed_m"]
    np.testing.assert_allclose(strokes, [2e-3] * 3 + [np.nan])


def test_any_force_of_a_specimen_can_be_ranked_by(file):
    table = rank(file, allowed_force="24 N", by="mass_g")
    np.testing.assert_allclose(table[AT_ALLOWED], [44e-3] * 3)
    with pytest.raises(RankError, match="up to 24 N in this table; allowed: none; other forces"):
        rank(read_summary(file), allowed_force="24 N")


def test_round_off_of_stored_curves_is_no_doubt(file):
    """The energy up to a force that is never reached is all absorbed energy."""
    before = read_summary(file).head(3)
    whole = with_allowed(file, before, Question(allowed_force=1e3))[AT_ALLOWED]
    barely = before.assign(absorbed_energy_within_model_J=whole * (1.0 - 1e-7))
    less = before.assign(absorbed_energy_within_model_J=whole * (1.0 - 1e-4))
    for table, doubted in ((barely, False), (less, True)):
        added = with_allowed(file, table, Question(allowed_force=1e3))
        assert list(rank(added, allowed_force="1 kN")["beyond_model"]) == [doubted] * 3


def test_each_design_bears_its_share_of_the_force_of_the_panel(file):
    """1200 N: 24 N of each of 50 specimens, 48 N of each of 25."""
    table = rank(file, panel=PANEL, allowed_force="1.2 kN", per="panel", by="mass_g")
    assert list(table["panel_specimens"]) == [50, 25, 50]
    np.testing.assert_allclose(table[AT_ALLOWED], [44e-3, 96e-3, 44e-3])
    np.testing.assert_allclose(table["panel_energy_J"], [2.2, 2.4, 2.2])
    np.testing.assert_allclose(table["counted_stroke_m"], [2e-3, 4e-3, 2e-3])
    assert list(table["passed_on_N"]) == [20.0] * 3  # the peak of the summary, which is invented


def test_stroke_and_force_of_a_panel_are_required_together(file):
    asked = {"panel": PANEL, "allowed_force": "1.2 kN", "per": "panel"}
    assert ids(rank(file, **asked, require={"max_stroke": "3 mm"}, by="mass_g")) == [0, 2]
    assert ids(rank(file, **asked, require={"min_absorbed": "2.3 J"})) == [1]


def test_curves_are_left_alone_where_the_table_has_the_answer(file):
    table = read_summary(file)
    assert with_allowed("nowhere.h5", table, Question(require={"max_stroke": 1e-3})) is table
    assert with_allowed("nowhere.h5", table, Question(per="panel", panel=PANEL)) is table


def test_energy_up_to_a_force_under_a_speed_is_from_the_filtered_force():
    """A blow of one row, as of a platen at full speed, does not end the count."""
    rows = np.arange(201.0)
    force = np.where(rows == 1.0, 1e3, 10.0)
    curve = {
        "time_s": 1e-5 * rows,
        "top_displacement_m": 1e-5 * rows,
        "reaction_top_N": force,
        "reaction_bottom_N": force,
        "work_in_J": 1e-4 * rows,
    }
    still, moving = (reached(curve | {"kinetic_J": each * rows}, 120.0) for each in (0.0, 1.0))
    assert still[1] < 2e-5
    assert moving == pytest.approx((2e-2, 2e-3))
