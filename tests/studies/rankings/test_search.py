"""The study of the search: a piece of it on the real crush, and its tables."""

import pytest

from tests.studies.rankings.search import KEYS, best_beside, cushion, found, peak, row_of, sheet
from tests.support.results.searches import energy, simulate

PEAK = 0.2780  # J, the best of the scan of 60 walls


def test_the_sharp_peak_is_found_without_a_hint(tmp_path):
    """The first sixteen designs miss it by 4 %."""
    value, case = found(peak(), 4, tmp_path, evaluations=24)
    assert value > 0.99 * PEAK
    assert 0.53e-3 < case.lattice.wall_thickness < 0.67e-3


def test_designs_beside_the_searches():
    counts = [[len(cases) for cases in q.beside.values()] for q in (peak(), cushion())]
    assert counts == [[60], [36, 36]]
    assert [peak().evaluations, cushion().evaluations] == [30, 35]
    scan = [case.lattice for case in peak().beside["a scan of 60 walls"]]
    assert {(lattice.kind, lattice.cells_x, lattice.cells_y) for lattice in scan} == {("hex", 4, 2)}
    assert (scan[0].wall_thickness, scan[-1].wall_thickness) == (0.3e-3, 1.2e-3)
    assert all(None not in cases for cases in cushion().beside.values())
    assert tuple(cushion().search.recipe.search) == KEYS


def test_rows_compare_with_the_first_beside(tmp_path):
    """The invented energy is defined in `tests.support.results.searches`."""
    question = cushion()
    beside = best_beside(question, tmp_path, simulate)
    one = found(question, 1, tmp_path, simulate)
    table = sheet(question, beside, [one])
    assert [row[:2] for row in table.rows] == [
        ["a grid", "36"],
        ["another grid", "36"],
        ["search, seed 1", "35"],
    ]
    (first, _), (second, _) = beside.values()
    assert first == max(map(energy, question.beside["a grid"]))
    shares = [float(row[3]) for row in table.rows]
    assert shares == pytest.approx([100.0, 100.0 * second / first, 100.0 * one[0] / first], abs=0.1)


def test_design_in_words():
    words = "50.0", "50.0", "square 4 x 2, 0.400 mm"
    assert row_of(0.05, cushion().beside["a grid"][0], 0.1) == words
