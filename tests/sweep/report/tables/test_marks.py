"""Marks of doubtful results, and of designs that do not print as drawn."""

import pandas as pd
import pytest

from sweep.columns import end_columns
from sweep.ranking.rank import ranked
from sweep.report.tables.legend import UNSURE, legend
from sweep.report.tables.marks import MEANINGS, mark_notes
from sweep.report.tables.sheets import PASSED_OVER, ranking_sheets
from tests.support.results.specimens import CRUSHED_SOLID, IMPACTS, SPARSE, summary

NAN = float("nan")


def marked(table, **asked):
    """The first cells of the rows of a table, and its legend."""
    ranking = ranked(table, **asked)
    (sheet,) = ranking_sheets(ranking, table)
    return [row[0] for row in sheet.rows], legend(ranking)


KNOWN = IMPACTS.assign(peak_deceleration_filtered_m_per_s2=500.0)
ROUGH = ["", "walls of 1.5 lines of 0.4 mm"]
CROSSED = SPARSE | {"contact_model": "none", "max_crossings": 3}
TWO = summary({}, {"mass_g": 2.0})


@pytest.mark.parametrize(
    ("table", "by", "places", "meanings"),
    [
        (summary(CRUSHED_SOLID, SPARSE), "absorbed_energy_J", ["1*", "2 !"], "!"),
        (summary(CRUSHED_SOLID, SPARSE), None, ["1*", "2 "], ""),
        (summary(CRUSHED_SOLID, CROSSED), "absorbed_energy_J", ["1 !", "2 x"], "!x"),
        (TWO.assign(stretch_over_curve=[1.2, 0.9]), None, ["1*^", "2 "], "^"),
        (TWO.assign(stretch_over_curve=[NAN, 1.0]), None, ["1*", "2 "], ""),
        (TWO.assign(does_not_print=ROUGH), None, ["1*", "2 p"], "p"),
        (TWO.assign(does_not_print=""), None, ["1*", "2 "], ""),
    ],
)
def test_what_is_doubtful_or_does_not_print_is_marked(table, by, places, meanings):
    seen, words = marked(table, by=by)
    assert seen == places
    assert "".join(mark for mark, text in MEANINGS.items() if text in words) == meanings


def test_coarse_steps_are_explained_by_the_measure_of_their_loading():
    impacts = IMPACTS.assign(integrator_share=[0.009, 0.011])
    crushes = TWO.assign(load_step_error=[0.004, 0.006], integrator_share=NAN)
    moving = TWO.assign(load_step_error=NAN, integrator_share=[0.009, 0.011])
    for table, words in (
        (impacts, ("time steps", "1 %", "integrator_share", "time_step")),
        (moving, ("time steps", "1 %", "integrator_share", "time_step")),
        (crushes, ("load steps", "0.5 %", "load_step_error", "load_steps")),
    ):
        seen, text = marked(table)
        assert seen == ["1*", "2 i"]
        assert all(word in text for word in words)
    assert "integrator_share" not in text


def test_a_pulse_that_the_filter_cuts_is_marked():
    """5 J over 2 cm need 250 N on the mean, which a striker of 100 g takes at 2500 m/s^2."""
    hit = {"striker_mass_g": 100.0, "absorbed_energy_J": 5.0, "indentation_m": 0.02}
    table = IMPACTS.assign(**hit, peak_deceleration_filtered_m_per_s2=[2400.0, 2600.0])
    seen, text = marked(table)
    assert seen == ["1*f", "2 "]
    assert MEANINGS["f"] in text
    peaks = {"peak_deceleration_m_per_s2": [2700.0, 8000.0]}
    rising = table.assign(**peaks, peak_deceleration_filtered_m_per_s2=2600.0)
    assert marked(rising)[0] == ["1*", "2 f"]


def test_an_impact_that_uses_up_the_stroke_is_marked():
    """Of 10 mm, 5 are used and 5 or half a millimetre are left."""
    table = KNOWN.assign(height_m=0.01, peak_strain=0.5, stroke_left_m=[0.5e-3, 5e-3])
    seen, text = marked(table)
    assert seen == ["1*s", "2 "]
    assert MEANINGS["s"] in text
    seen, _ = marked(table.assign(stroke_left_m=[-0.5e-3, 5e-3]))
    assert seen == ["1*", "2 !"]


def test_a_retry_that_changes_what_varies_is_marked():
    retries = ["", "solver.time_step = 1.25 us"]
    table = KNOWN.assign(retry=retries)
    assert marked(table)[0] == ["1*", "2 "]
    seen, text = marked(table.assign(**{"solver.time_step": 2e-4}))
    assert seen == ["1*", "2 r"]
    assert MEANINGS["r"] in text


def test_steps_that_are_too_long_for_the_peak_are_marked():
    (sheet,) = ranking_sheets(ranked(table := TWO.assign(peak_force_N=[10.0, NAN])), table)
    seen, text = [row[0] for row in sheet.rows], legend(ranked(table))
    assert seen == ["1*", "2 i"]
    assert "too long for the greatest force (–)" in text
    assert "load_step_error" not in text


def test_impacts_of_rows_too_far_apart_for_their_filter_are_marked():
    seen, text = marked(IMPACTS)
    assert seen == ["1*", "2 i"]
    assert "i: time steps are too long for peaks of the force" in text
    assert marked(KNOWN)[0] == ["1*", "2 "]


def test_the_greatest_estimate_is_told():
    table = TWO.assign(integrator_share=[0.02, 0.153])
    assert "above 1 % of the work, here up to 15 %" in " ".join(mark_notes(ranked(table).table))


def test_a_measure_of_another_loading_is_not_explained():
    """The integrator takes much of the vibrations of a dead load, which is no mark of it."""
    crushes = TWO.assign(load_step_error=[0.004, 0.006], integrator_share=NAN, path_error=NAN)
    load = {"loading_mode": "force", "force_N": 5.0, "integrator_share": 0.3}
    loads = TWO.assign(**load, path_error=[0.004, 0.006], case_id=["c", "d"])
    words = " ".join(mark_notes(ranked(pd.concat([crushes, loads], ignore_index=True)).table))
    assert ("load_step_error" in words, "path_error" in words) == (True, True)
    assert "integrator_share" not in words


def test_designs_that_are_passed_over_are_counted():
    table = summary(CRUSHED_SOLID, SPARSE)
    ranking = ranked(table, by="absorbed_energy_J")
    assert list(ranking.table["passed_on_N"]) == [25.0, 900.0]
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.notes == (PASSED_OVER.format("By", "1 design"),)


def test_a_lattice_that_packs_at_two_strains_is_marked():
    rising = {"packing_span": 0.21, "densification_strain": NAN, "peak_strain": 0.5}
    table = summary({"packing_span": 0.21}, rising, {})
    (sheet,) = ranking_sheets(ranked(table), table)
    assert [row[-2] for row in sheet.rows] == ["54~", "> 50", "54"]
    assert UNSURE in legend(ranked(table))
    ends = dict(zip(end_columns("densification_strain"), (0.3, 0.54), strict=True))
    ranges = table.iloc[:1].assign(**ends)
    for others in (table.iloc[2:], table.iloc[1:], ranges):
        assert UNSURE not in legend(ranked(others))


def test_a_peak_that_load_steps_miss_is_marked():
    seen, text = marked(TWO.assign(peak_step_error=[0.019, 0.24]))
    assert seen == ["1*", "2 i"]
    assert "above 2 % of a peak force, here up to 24 %" in text
    assert "up to a force near the peak" in text
