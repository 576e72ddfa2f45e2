"""The legend of a ranking explains what its tables show, and nothing else."""

from sweep.ranking.rank import ranked
from sweep.report.tables.legend import EARLY, SECOND, legend
from sweep.report.tables.marks import MEANINGS
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import CRUSHED_SOLID, SPARSE, summary


def test_what_marks_mean_is_said_once_for_all_scenes():
    platens = [{"platen": platen} for platen in ("glued", "contact", "sliding")]
    table = summary(*(CRUSHED_SOLID | platen for platen in platens))
    ranking = ranked(table, by="absorbed_energy_J")
    sheets = list(ranking_sheets(ranking, table))
    assert [sheet.rows[0][0] for sheet in sheets] == ["1 !"] * 3
    assert not any(MEANINGS["!"] in sheet.notes for sheet in sheets)
    assert legend(ranking).count(MEANINGS["!"]) == 1


def test_a_crush_that_ends_below_the_allowed_force_absorbs_at_least_so_much():
    given = {"absorbed_energy_at_50N_J": 0.2, "loading.allowed_forces": 50.0}
    table = summary(CRUSHED_SOLID | given, SPARSE | given)
    (sheet,) = ranking_sheets(ranked(table, allowed_force=50.0), table)
    energy = sheet.heads.index("usable mJ")
    assert sorted(row[energy] for row in sheet.rows) == ["200", "> 200"]
    assert EARLY in legend(ranked(table, allowed_force=50.0))
    (sheet,) = ranking_sheets(ranked(table), table)
    assert EARLY not in legend(ranked(table))
    assert not any(text.startswith(">") for row in sheet.rows for text in row[:energy])


def test_second_cycle_is_told_where_there_is_one():
    table = summary({"second_cycle_share": 0.7}, {})
    ranking = ranked(table)
    (sheet,) = ranking_sheets(ranking, table)
    assert sorted(row[sheet.heads.index("cycle 2 %")] for row in sheet.rows) == ["70", "–"]
    assert SECOND in legend(ranking)
    table = summary({})
    (sheet,) = ranking_sheets(ranked(table), table)
    assert "cycle 2 %" not in sheet.heads
    assert SECOND not in legend(ranked(table))
