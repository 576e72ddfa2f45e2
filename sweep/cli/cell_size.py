"""What `lattice.cell_size` has become: whole numbers of cells, and their size; and the period of a
sheet.
"""

from collections.abc import Sequence
from typing import Any

from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.config.kinds.direction import ALONG
from sweep.config.kinds.sheet import SIDES, Surface
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.numbers import in_unit, text_in


def cell_sentences(cases: Sequence[Case], infill: float | None = None) -> list[str]:
    """A line for each lattice that a size of cells has divided; infill: the share that a config
    gives for cases that have none of their own.

    "lattice.cell_size 4 mm: 25 x 4 cells of 4 x 3.75 mm (square)"
    """
    lattices = [case.lattice for case in cases]
    sized = (made for made in lattices if isinstance(made, Cells) and made.cell_size is not None)
    sheets = (
        _of_sheet(case.lattice, case.axes.get("lattice.infill", infill))
        for case in cases
        if isinstance(case.lattice, Surface)
    )
    return list(dict.fromkeys([*map(_sentence, sized), *sheets]))


def _of_sheet(made: Surface, infill: Any) -> str:
    """A line: "gyroid, pressed along the print axis: 2 x 6.25 mm, the period, in 12.5 mm"; of a
    block, "...; a block of 12.5 x 12.5 x 12.5 mm within perimeters".
    """
    height, period = (text_in(size, "mm") for size in (made.pressed_height, made.period))
    count = f"{made.pressed_height / made.period:.4g} x {period}"
    axis = "along" if made.pressed == ALONG else "across"
    share = f", {_share(made.infill, infill)}" if isinstance(made, SlicedSheet) else ""
    line = f"{made.name}{share}, pressed {axis} the print axis: {count}, the period, in {height}"
    if made.tied:
        return line
    size = " x ".join(f"{in_unit(made.value(side), 'mm'):.4g}" for side in SIDES)
    return f"{line}; a block of {size} mm within perimeters"


def _share(taken: float, given: Any) -> str:
    """The share of a sheet whose period fits, and the one given, if it is another one."""
    texts = [text_in(share, "%", 3) for share in (taken, given or taken)]
    return " for ".join(dict.fromkeys(texts))


def _sentence(made: Cells) -> str:
    from sweep.design.sizing import cell_of

    width, height = (f"{in_unit(side, 'mm'):.3g}" for side in cell_of(made.geometry))
    name = " ".join(filter(None, (made.kind, made.orientation)))
    size = text_in(made.cell_size or 0.0, "mm")
    cells = f"{made.cells_x} x {made.cells_y} cells of {width} x {height} mm"
    return f"lattice.cell_size {size}: {cells} ({name})"
