"""Tables of a search: its finalists and its front."""

import pytest
from pandas import DataFrame

from sweep.ranking.rank import ranked
from sweep.ranking.spread import AS_GIVEN, FINE, Spread
from sweep.report.tables.search_sheets import finalist_sheet, front_sheet, nearest_sheet
from tests.support.results.specimens import designs, summary

ENERGY = "absorbed_energy_J"
OWN = summary(*designs([1.0, 2.0], [0.4, 0.3]))
NAN = float("nan")


def spread(rows, column=ENERGY, **corners):
    """The spread of two designs; corners: values of both, by name."""
    values = {AS_GIVEN: rows[column], **corners}
    table = DataFrame({name: list(numbers) for name, numbers in values.items()})
    failed = int(table.isna().to_numpy().sum())
    places = table.rank(ascending=column == "mass_g", method="min")
    masses = DataFrame({AS_GIVEN: list(rows["mass_g"])})
    return Spread(rows, column, table, places, failed, masses, ())


def sheet(fine, thin, thick, column=ENERGY):
    """The sheet of two designs; arguments: values of both at one corner."""
    corners = {FINE: fine, "walls -5 %": thin, "walls +5 %": thick}
    return finalist_sheet(spread(ranked(OWN, by=column).table, column, **corners), OWN)


def test_row_has_the_fine_mesh_and_the_spread():
    found = sheet((0.39, 0.28), (0.35, 0.27), (0.41, 0.29))
    assert found.title == f"Best designs, simulated again: {ENERGY}"
    told = ["0.400", "0.390", "0.350", "walls -5 %", "0.410", "walls +5 %"]
    assert found.rows[0][-6:] == told
    assert len(found.notes) == 1


@pytest.mark.parametrize(
    ("corners", "is_certain"),
    [
        (((0.36, 0.36), (0.36, 0.29), (0.37, 0.31)), False),
        (((0.39, 0.31), (0.39, 0.3), (0.3, 0.31)), True),
    ],
)
def test_a_first_place_that_the_mesh_or_a_print_may_reverse_is_told(corners, is_certain):
    notes = sheet(*corners).notes
    near = "The first place is not certain: the mesh errors of numbers 1, 2 overlap."
    assert (near in notes) != is_certain
    assert ("Number 2 is the best with walls +5 %." in notes) == is_certain


def test_least_is_the_best_where_the_column_says_so():
    found = sheet((1.0, 2.0), (1.0, 2.0), (3.0, 2.1), "mass_g")
    assert found.notes[1] == "Number 2 is the best with walls +5 %."
    assert "with walls +5 % it has 300 % of this value." in found.notes[2]
    assert found.notes[3].startswith("The safest of these is number 2, with 2.10")


@pytest.mark.parametrize("missing", [1, 3])
def test_missing_values_are_told(missing):
    values = [(NAN, 0.28), (NAN, 0.27), (NAN, 0.29)][:missing] + [(0.4, 0.28)] * (3 - missing)
    found = sheet(*values)
    assert found.notes[1] == f"{missing} values are missing, as these cases failed."
    if missing == 3:
        assert found.rows[0][-5:] == ["–"] * 5


def test_front_has_both_columns():
    rows = ranked(OWN, by=ENERGY).table
    found = front_sheet(rows, OWN, "mass_g")
    assert found.title == f"Pareto front of {ENERGY} and mass_g"
    assert found.heads[-2:] == ["mass_g", ENERGY]
    assert [row[-2:] for row in found.rows] == [["1.00", "0.400"], ["2.00", "0.300"]]
    assert front_sheet(rows.head(0), OWN, "mass_g").rows == []


def test_a_sheet_of_one_scene_among_others_names_it():
    found = finalist_sheet(spread(ranked(OWN, by=ENERGY).table), OWN, several=True)
    assert found.title.endswith(f"{ENERGY}; crushed to 50 %, glued platens")


def test_masses_that_prints_change_are_a_range():
    masses = DataFrame({AS_GIVEN: [1.0, 2.0], "walls +5 %": [1.05, 2.0]})
    found = finalist_sheet(spread(ranked(OWN, by=ENERGY).table)._replace(masses=masses), OWN)
    assert found.columns[found.heads.index("mass g")] == ["1.00-1.05", "2.00"]


def test_what_does_not_print_is_marked_in_every_table():
    rough = OWN.assign(does_not_print=["", "walls of 1.5 lines"])
    ranking = ranked(rough, by=ENERGY)
    rows, ids = ranking.table, list(OWN["case_id"])
    nearest = nearest_sheet(ranking, dict(zip(ids, (0.1, 0.25), strict=True)), rough)
    assert [row[-1] for row in nearest.rows] == ["10.0", "25.0"]
    assert nearest.heads[-1] == "misses by %"
    finalists = finalist_sheet(spread(rows), rough)
    for sheet in (finalists, front_sheet(rows, rough, "mass_g"), nearest):
        first, second = (row[0] for row in sheet.rows)
        assert (first.endswith("p"), second.endswith("p")) == (False, True)
        assert any(note.startswith("p: does not print") for note in sheet.notes)
