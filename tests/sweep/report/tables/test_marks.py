"""Marks of doubtful results, and of designs that do not print as drawn."""

from sweep.ranking.rank import ranked
from sweep.report.tables.legend import UNSURE, legend
from sweep.report.tables.marks import MEANINGS
from sweep.report.tables.sheets import PASSED_OVER, ranking_sheets
from tests.support.results.specimens import CRUSHED_SOLID, IMPACTS, SPARSE, designs, summary

NAN = float("nan")


def test_energy_of_the_whole_crush_is_marked_where_the_model_does_not_hold_it():
    table = summary(CRUSHED_SOLID, SPARSE)
    ranking = ranked(table, by="absorbed_energy_J")
    assert [int(case_id) for case_id in ranking.table["case_id"]] == [1, 0]
    assert list(ranking.table["passed_on_N"]) == [25.0, 900.0]
    assert list(ranking.table["beyond_model"]) == [False, True]
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1*", "2 !"]
    assert sheet.notes == (PASSED_OVER.format("", "1 design"),)
    assert MEANINGS["!"] in legend(ranking)
    (sheet,) = ranking_sheets(ranked(table), table)
    assert sheet.notes == ()
    assert MEANINGS["!"] not in legend(ranked(table))


def test_walls_that_pass_through_one_another_are_marked():
    table = summary(CRUSHED_SOLID, SPARSE | {"contact_model": "none", "max_crossings": 3})
    ranking = ranked(table, by="absorbed_energy_J")
    assert list(ranking.table["crossed"]) == [False, True]
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1 !", "2 x"]
    assert MEANINGS["!"] in legend(ranking)
    assert MEANINGS["x"] in legend(ranking)


def test_coarse_steps_are_marked():
    table = IMPACTS.assign(integrator_share=[0.01, 0.1])
    (sheet,) = ranking_sheets(ranked(table), table)
    assert [row[0] for row in sheet.rows] == ["1*", "2 i"]
    assert MEANINGS["i"] in legend(ranked(table))


def test_walls_that_are_stretched_beyond_the_measured_curve_are_marked():
    table = summary({"stretch_over_curve": 1.2}, {"stretch_over_curve": 0.9, "mass_g": 2.0})
    (sheet,) = ranking_sheets(ranked(table), table)
    assert [row[0] for row in sheet.rows] == ["1*^", "2 "]
    assert MEANINGS["^"] in legend(ranked(table))
    table = summary({"stretch_over_curve": NAN}, {"stretch_over_curve": 1.0})
    assert MEANINGS["^"] not in legend(ranked(table))


def test_a_lattice_that_packs_at_two_strains_is_marked():
    rising = {"packing_span": 0.21, "densification_strain": NAN, "peak_strain": 0.5}
    table = summary({"packing_span": 0.21}, rising, {})
    (sheet,) = ranking_sheets(ranked(table), table)
    assert [row[-2] for row in sheet.rows] == ["54~", "> 50", "54"]
    assert UNSURE in legend(ranked(table))
    for others in (table.iloc[2:], table.iloc[1:]):
        assert UNSURE not in legend(ranked(others))


def test_what_does_not_print_is_marked():
    table = summary(*designs([1.0, 2.0], [0.3, 0.1]))
    table["does_not_print"] = ["", "walls of 1.5 lines of 0.4 mm"]
    (sheet,) = ranking_sheets(ranked(table), table)
    assert [row[0] for row in sheet.rows] == ["1*", "2 p"]
    assert "p: does not print as drawn" in legend(ranked(table))
    table["does_not_print"] = ""
    (sheet,) = ranking_sheets(ranked(table), table)
    assert [row[0] for row in sheet.rows] == ["1*", "2 "]
    assert "does not print" not in legend(ranked(table))
