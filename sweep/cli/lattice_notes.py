"""Notes on the lattices of a config: whole numbers of cells that follow from `lattice.cell_size`,
the period of a sheet, the walls of a drawing.
"""

from collections.abc import Sequence
from typing import Any

from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.config.kinds.direction import ALONG
from sweep.config.kinds.drawn import Drawn
from sweep.config.kinds.sheet import SIDES, Surface
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.numbers import counted, in_unit, text_in
from sweep.plain_text import plain


def lattice_notes(cases: Sequence[Case], infill: float | None = None) -> list[str]:
    """A line for each different lattice whose sizes do not stand in the config as they are.

    infill: the share that a config gives for cases that have none of their own.
    """
    lattices = [case.lattice for case in cases]
    cells = (lattice for lattice in lattices if isinstance(lattice, Cells))
    sized = (lattice for lattice in cells if lattice.cell_size is not None)
    sheets = (
        _of_sheet(case.lattice, case.axes.get("lattice.infill", infill))
        for case in cases
        if isinstance(case.lattice, Surface)
    )
    drawings = (_of_drawing(lattice) for lattice in lattices if isinstance(lattice, Drawn))
    return list(dict.fromkeys([*map(_of_cells, sized), *sheets, *drawings]))


def _of_drawing(lattice: Drawn) -> str:
    """A line: "a.svg: 12.5 x 12.5 mm, 16 joints, 24 walls; 2 walls end loose, one at 3, 4.2 mm"."""
    from sweep.design.drawn import loose_ends

    joints, walls = lattice.counts
    size = _pair((lattice.width, lattice.height), " x ")
    counts = f"{counted(joints, 'joint')}, {counted(walls, 'wall')}"
    sentence = f"{plain(lattice.name)}: {size}, {counts}"
    loose = loose_ends(lattice.network)
    if not len(loose):
        return sentence
    ends = "1 wall ends loose, at" if len(loose) == 1 else f"{len(loose)} walls end loose, one at"
    return f"{sentence}; {ends} {_pair(lattice.drawing.joints[loose[0]], ', ')}"


def _pair(lengths: tuple[float, float], between: str) -> str:
    """Two lengths (m) in mm."""
    x, y = lengths
    return f"{in_unit(x, 'mm'):.5g}{between}{text_in(y, 'mm', 5)}"


def _of_sheet(lattice: Surface, infill: Any) -> str:
    """A line: "gyroid, pressed along the print axis: 2 periods of 6.25 mm in a height of 12.5 mm";
    for a block, "...; a block of 12.5 x 12.5 x 12.5 mm within perimeters".
    """
    height, period = (text_in(size, "mm") for size in (lattice.pressed_height, lattice.period))
    number = f"{lattice.pressed_height / lattice.period:.4g}"
    count = f"{number} period{'s' * (number != '1')} of {period} in a height of {height}"
    axis = "along" if lattice.pressed == ALONG else "across"
    share = f", {_share(lattice.infill, infill)}" if isinstance(lattice, SlicedSheet) else ""
    line = f"{lattice.name}{share}, pressed {axis} the print axis: {count}"
    if lattice.tied_sides:
        return line
    size = " x ".join(f"{in_unit(lattice.value(side), 'mm'):.4g}" for side in SIDES)
    return f"{line}; a block of {size} mm within perimeters"


def _share(fitting: float, requested: Any) -> str:
    """The share of infill of a sheet whose period fits, and the requested share, if it is another
    one.
    """
    texts = [text_in(share, "%", 3) for share in (fitting, requested or fitting)]
    return " for ".join(dict.fromkeys(texts))


def _of_cells(lattice: Cells) -> str:
    """A line: "lattice.cell_size 4 mm: 25 x 4 cells of 4 x 3.75 mm (square)"."""
    from sweep.design.sizing import cell_of

    width, height = (f"{in_unit(side, 'mm'):.3g}" for side in cell_of(lattice.geometry))
    name = " ".join(filter(None, (lattice.kind, lattice.orientation)))
    size = text_in(lattice.cell_size or 0.0, "mm")
    cells = f"{lattice.cells_x} x {lattice.cells_y} cells of {width} x {height} mm"
    return f"lattice.cell_size {size}: {cells} ({name})"
