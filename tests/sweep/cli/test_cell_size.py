"""The sentence that says what a size of cells has become."""

from sweep.cli.cell_size import cell_sentences
from sweep.config.case import Case

PANEL = dict(width=0.1, height=15e-3, depth=0.05)


def test_each_lattice_is_told_once():
    sized = dict(PANEL, cell_size=4e-3)
    cases = [
        Case.of(lattice=PANEL),
        Case.of(lattice=sized),
        Case.of(lattice=sized, loading=dict(strain=0.3)),
        Case.of(lattice=dict(sized, kind="hex", orientation="flat")),
    ]
    assert cell_sentences(cases) == [
        "lattice.cell_size 4 mm: 25 x 4 cells of 4 x 3.75 mm (square)",
        "lattice.cell_size 4 mm: 25 x 3 cells of 3.95 x 4.29 mm (hex flat)",
    ]
