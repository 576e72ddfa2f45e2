"""The legend of a ranking explains what its tables show, and nothing else."""

from sweep.ranking.rank import ranked
from sweep.report.tables.legend import EARLY, PULLED, TWICE, legend
from sweep.report.tables.marks import MEANINGS
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import CRUSHED_SOLID, SPARSE, summary


def test_what_marks_mean_is_said_once_for_all_scenes():
    table = summary(*(CRUSHED_SOLID | {"platen": platen} for platen in ("glued", "contact")))
    ranking = ranked(table, by="absorbed_energy_J")
    sheets = list(ranking_sheets(ranking, table))
    assert [sheet.rows[0][0] for sheet in sheets] == ["1 !"] * 2
    assert not any(MEANINGS["!"] in sheet.notes for sheet in sheets)
    assert legend(ranking).count(MEANINGS["!"]) == 1


def test_a_platen_that_pulls_is_explained():
    for energy, expected in ((0.1, False), (-0.1, True)):
        text = legend(ranked(summary(SPARSE | {"returned_energy_J": energy})))
        assert (PULLED in text) == expected


def test_a_crush_that_ends_below_the_allowed_force_absorbs_at_least_so_much():
    table = summary(CRUSHED_SOLID, SPARSE).assign(absorbed_energy_at_50N_J=0.2)
    for force, energies in {50.0: ["200", "> 200"], None: ["200", "300"]}.items():
        ranking = ranked(table, allowed_force=force)
        (sheet,) = ranking_sheets(ranking, table)
        assert sorted(sheet.columns[sheet.heads.index("usable mJ")]) == energies
        assert (EARLY in legend(ranking)) == (force is not None)
        assert TWICE not in legend(ranking)
