"""The study of the search: a piece of it on the real crush, and its tables."""

from tests.studies.search import KEYS, cushion, found, peak, sheet, told

PEAK = 0.2817  # J, the best of the scan of 60 walls


def test_the_sharp_peak_is_found_without_a_hint(tmp_path):
    """The first sixteen designs miss it by 4 %."""
    value, case = found(peak(), 4, tmp_path, evaluations=24)
    assert value > 0.99 * PEAK
    assert 0.53e-3 < case.lattice.wall_thickness < 0.67e-3


def test_designs_beside_the_searches():
    assert [len(question.beside) for question in (peak(), cushion())] == [60, 36]
    assert all(None not in question.beside for question in (peak(), cushion()))
    scan = [case.lattice for case in peak().beside]
    assert {(lattice.kind, lattice.cells_x, lattice.cells_y) for lattice in scan} == {("hex", 4, 2)}
    assert (scan[0].wall_thickness, scan[-1].wall_thickness) == (0.3e-3, 1.2e-3)
    assert {question.evaluations < len(question.beside) for question in (peak(), cushion())} == {
        True
    }
    assert tuple(cushion().search.search) == KEYS


def test_rows_compare_with_the_best_beside():
    question = peak()
    table = sheet(question, (0.2, question.beside[0]), [(0.3, question.beside[20])])
    assert table.rows[0][1:] == ["60", "200", "100.0", "hex 4 x 2, 0.300 mm"]
    assert table.rows[1][:4] == ["search, seed 1", "30", "300", "150.0"]


def test_design_in_words():
    words = "50.0", "50.0", "square 4 x 2, 0.400 mm"
    assert told(0.05, cushion().beside[0], 0.1) == words
