"""What `lattice.cell_size` has become: whole numbers of cells, and their size."""

from collections.abc import Iterable

from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.numbers import in_unit, text_in


def cell_sentences(cases: Iterable[Case]) -> list[str]:
    """A line for each lattice that a size of cells has divided.

    "lattice.cell_size 4 mm: 25 x 4 cells of 4 x 3.75 mm (square)"
    """
    lattices = (case.lattice for case in cases)
    sized = (made for made in lattices if isinstance(made, Cells) and made.cell_size is not None)
    return list(dict.fromkeys(map(_sentence, sized)))


def _sentence(made: Cells) -> str:
    from sweep.design.sizing import cell_of

    width, height = (f"{in_unit(side, 'mm'):.3g}" for side in cell_of(made.geometry))
    name = " ".join(filter(None, (made.kind, made.orientation)))
    size = text_in(made.cell_size or 0.0, "mm")
    cells = f"{made.cells_x} x {made.cells_y} cells of {width} x {height} mm"
    return f"lattice.cell_size {size}: {cells} ({name})"
