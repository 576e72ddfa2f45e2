"""What a search tells of its finalists and of its front."""

import pytest
from pandas import DataFrame

from sweep.ranking.rank import ranked
from sweep.ranking.spread import AS_GIVEN, FINE, Spread
from sweep.report.search_sheets import finalist_sheet, front_sheet
from tests.support.results.specimens import designs, summary

ENERGY = "absorbed_energy_J"
OWN = summary(*designs([1.0, 2.0], [0.4, 0.3]))
NAN = float("nan")


def sheet(fine, thin, thick, column=ENERGY):
    """The sheet of two designs; arguments: values of both at one corner."""
    rows = ranked(OWN, by=column).table
    values = {AS_GIVEN: rows[column], FINE: fine, "walls -5 %": thin, "walls +5 %": thick}
    table = DataFrame({name: list(numbers) for name, numbers in values.items()})
    failed = int(table.isna().to_numpy().sum())
    return finalist_sheet(Spread(rows, column, table, table.rank(), failed), OWN)


def test_row_has_the_fine_mesh_and_the_spread():
    found = sheet((0.39, 0.28), (0.35, 0.27), (0.41, 0.29))
    assert found.title == f"Best designs, simulated again: {ENERGY}"
    told = ["0.400", "0.390", "0.350", "walls -5 %", "0.410", "walls +5 %"]
    assert found.rows[0][-6:] == told
    assert len(found.notes) == 1


def test_narrow_peak_and_the_safest_design_are_told():
    found = sheet((0.39, 0.28), (0.35, 0.27), (0.04, 0.29))
    told = "The first design stands on a narrow peak: walls +5 % leaves 10 % of it."
    assert found.notes[1:] == (
        told,
        "The safest of these is number 2, with 0.270 at its worst.",
    )


def test_least_is_the_best_where_the_column_says_so():
    found = sheet((1.0, 2.0), (1.0, 2.0), (3.0, 2.1), "mass_g")
    assert "walls +5 % leaves 300 % of it." in found.notes[1]
    assert found.notes[2].startswith("The safest of these is number 2, with 2.10")


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
