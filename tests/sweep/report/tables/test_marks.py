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
HIT = {"striker_mass_g": 100.0, "absorbed_energy_J": 5.0, "indentation_m": 0.02}
PULSE = IMPACTS.assign(**HIT, peak_deceleration_filtered_m_per_s2=[2400.0, 2600.0])
"""5 J over 2 cm need 250 N on the mean, which a striker of 100 g takes at 2500 m/s^2."""
RISING = PULSE.assign(
    peak_deceleration_m_per_s2=[2700.0, 8000.0], peak_deceleration_filtered_m_per_s2=2600.0
)
PRESSED = KNOWN.assign(height_m=0.01, peak_strain=0.5)
"""Of 10 mm, 5 are used."""
RETRIED = KNOWN.assign(retry=["", "solver.time_step = 1.25 us"])


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
        (PULSE, None, ["1*f", "2 "], "f"),
        (RISING, None, ["1*", "2 f"], "f"),
        (PRESSED.assign(stroke_left_m=[0.5e-3, 5e-3]), None, ["1*s", "2 "], "s"),
        (PRESSED.assign(stroke_left_m=[-0.5e-3, 5e-3]), None, ["1*", "2 !"], "!"),
        (RETRIED, None, ["1*", "2 "], ""),
        (RETRIED.assign(**{"solver.time_step": 2e-4}), None, ["1*", "2 r"], "r"),
    ],
)
def test_what_is_doubtful_or_does_not_print_is_marked(table, by, places, meanings):
    seen, words = marked(table, by=by)
    assert seen == places
    assert "".join(mark for mark, text in MEANINGS.items() if text in words) == meanings


@pytest.mark.parametrize(
    ("table", "words"),
    [
        (
            KNOWN.assign(integrator_share=[0.009, 0.011]),
            ("time steps", "1 %", "integrator_share", "time_step"),
        ),
        (IMPACTS, ("i: time steps are too long for peaks of the force",)),
        (
            TWO.assign(load_step_error=NAN, integrator_share=[0.009, 0.153]),
            ("above 1 % of the work, here up to 15 %", "integrator_share", "time_step"),
        ),
        (
            TWO.assign(load_step_error=[0.004, 0.006], integrator_share=NAN),
            ("load steps", "0.5 %", "load_step_error", "load_steps"),
        ),
        (
            TWO.assign(peak_step_error=[0.019, 0.24]),
            ("above 2 % of a peak force, here up to 24 %", "up to a force near the peak"),
        ),
        (TWO.assign(peak_force_N=[10.0, NAN]), ("too long for the greatest force (–)",)),
    ],
)
def test_coarse_steps_are_explained_by_the_measure_of_their_loading(table, words):
    seen, text = marked(table)
    assert seen == ["1*", "2 i"]
    assert all(word in text for word in words)
    others = {"integrator_share", "load_step_error"} - {*words}
    assert not any(other in text for other in others)


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
