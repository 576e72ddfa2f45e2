"""The spread as a table, and in sentences."""

from pandas import DataFrame

from sweep.ranking.spread import AS_GIVEN, Spread
from sweep.report.tables.spread_sheets import spread_sheets
from tests.support.results.specimens import designs, summary

COLUMN = "mass_g"
OWN = summary(*designs([1.0, 2.0], [0.4, 0.3]))


def sheet(first, second, failed=0):
    """The sheet of two designs of 1 and 2 g, with their masses at one corner."""
    rows = OWN.assign(place=[1, 2], scene="crushed", budget_g=5.0)
    values = {AS_GIVEN: [1.0, 2.0], "friction 0.9": [first, second]}
    table = DataFrame(values if first else {AS_GIVEN: [1.0, 2.0]})
    spread = Spread(rows, COLUMN, table, table.rank(method="min"), failed, table, ())
    return next(spread_sheets([spread], OWN))


def test_row_has_the_ends_and_where_they_are():
    found = sheet(3.0, 2.5, failed=2)
    assert found.rows[0][0] == "1"
    assert found.rows[0][2:] == ["1.00", "1.00", AS_GIVEN, "3.00", "friction 0.9", "1 to 2"]
    assert found.notes[-1].startswith("2 values are missing")
    assert found.title == "Spread of mass_g: crushed, up to 5 g"
