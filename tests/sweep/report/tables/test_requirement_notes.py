"""Requirements in sentences and columns."""

import pytest

from sweep.ranking.rank import ranked
from sweep.report.tables.legend import legend
from sweep.report.tables.requirement_notes import UNEQUAL
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import CRUSHES, IMPACTS

NAN = float("nan")
PANEL = ("130 mm", "50 mm")  # 50 specimens


UP_TO = CRUSHES.assign(absorbed_energy_at_50N_J=0.1)


@pytest.mark.parametrize(
    ("table", "asked", "stroke"),
    [
        (CRUSHES, {}, None),
        (CRUSHES, {"require": {"max_stroke": "7 mm"}}, "6.75"),
        (CRUSHES, {"require": {"max_force": "70 N"}}, "6.75"),
        (UP_TO, {"allowed_force": "50 N"}, None),
        (UP_TO.assign(stroke_at_allowed_m=3e-3), {"allowed_force": "50 N"}, "3.00"),
    ],
)
def test_stroke_is_shown_where_something_is_limited_and_it_is_known(table, asked, stroke):
    (sheet,) = ranking_sheets(ranked(table, **asked), table)
    shown = dict(zip(sheet.heads, sheet.rows[0], strict=True))
    assert shown.get("stroke mm") == stroke


@pytest.mark.parametrize(("table", "head"), [(CRUSHES, "peak N"), (IMPACTS, "force N")])
def test_force_of_the_panel_stands_beside_that_of_the_specimen(table, head):
    (sheet,) = ranking_sheets(ranked(table, panel=PANEL), table)
    for row in sheet.rows:
        one, all_of = (float(row[sheet.heads.index(name)]) for name in (head, "panel N"))
        assert all_of == 50.0 * one


def test_number_of_specimens_is_a_range_if_designs_differ_in_width():
    table = CRUSHES.assign(outer_width_m=[13e-3, 13e-3, 14e-3])
    text = legend(ranked(table, panel=PANEL))
    assert "of the 45 to 50 separate specimens of a panel" in text
    assert UNEQUAL in text
    assert UNEQUAL not in legend(ranked(CRUSHES, panel=PANEL))
    large = legend(ranked(CRUSHES.assign(outer_width_m=0.13, depth_m=0.05), panel=PANEL))
    assert ("which is one specimen of" in large, "neighbours" in large) == (True, False)


@pytest.mark.parametrize("depth", ["50 mm", "56 mm", "54 mm"])
def test_a_panel_of_another_size_than_that_of_the_question_is_told(depth):
    words = legend(ranked(CRUSHES, panel=("130 mm", depth)))
    told = f"make a panel whose sides differ by up to 7 % from the 130 x {depth} of the question"
    assert (told in words) == ("of the question" in words) == (depth != "50 mm")


@pytest.mark.parametrize(
    ("changes", "said", "unsaid"),
    [
        ({}, "mass: of the part", "first loading"),
        ({"sides": "tied, fixed period"}, "mass: of one period", "of the part"),
        ({"direction": "out_of_plane"}, "at their first loading", "of sheets"),
        ({"lattice_kind": "gyroid"}, "of sheets are of walls as drawn, at their", "long the cells"),
    ],
)
def test_masses_are_of_a_part_or_period_and_walls_at_their_first_loading(changes, said, unsaid):
    words = legend(ranked(CRUSHES.assign(**changes)))
    assert (said in words, unsaid in words) == (True, False)


@pytest.mark.parametrize(
    ("by", "head", "value"),
    [
        ("peak_base_pressure_Pa", "base kPa", "200"),
        ("peak_deceleration_filtered_m_per_s2", "decel. g0", "51.0"),
    ],
)
def test_a_measure_that_sorts_is_shown_once(by, head, value):
    struck = IMPACTS.assign(peak_base_pressure_Pa=[2e5, 3e5])
    (sheet,) = ranking_sheets(ranked(struck, by=by), struck)
    assert (sheet.heads[-1], sheet.rows[0][-1], by in sheet.heads) == (head, value, False)
