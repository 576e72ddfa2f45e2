"""Screening: a design that is pressed along its cells is first crushed as one cell of its walls.

The unit column is a tube of one cell of the same width, height, walls, mesh and loading. Its
energies, forces and mass are scaled by the ratio of the masses of the design and of the column, its
stresses by the ratio of the relative densities; strains and energies per gram are not scaled. A
tube has no neighbours that hold its walls, and no cells that fold against one another: it absorbs
less than its share of the design, by a factor that depends on the infill. So the best designs are
chosen within each infill, not between infills.

Columns are ordinary cases, in a results file of their own beside the results of the sweep, so that
they are no designs of its ranking: `armor.screen.h5` beside `armor.h5`. The values in it are not
scaled.
"""

import os
from collections.abc import Sequence
from typing import Any

from pandas import DataFrame

from sweep.columns import describe_column
from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.lattice import Lattice
from sweep.design.drawing import extent
from sweep.design.upright_plan import mirror_fault
from sweep.ranking.question import Question
from sweep.ranking.rank import answer
from sweep.ranking.unfinished import loaded
from sweep.result import design_columns
from sweep.running.beside.run_beside import How, file_beside, run_beside
from sweep.store.read import read_summary

EXTENSIVE = ("J", "N", "g")
PER_AREA = ("Pa", "J/m^3")
ONE = 1, 1


def has_column(design: Case) -> bool:
    """Whether one cell can represent a design: a crush along several equal cells without
    outline.
    """
    lattice, crushed = design.lattice, isinstance(design.loading, Crush)
    if not (isinstance(lattice, Cells) and crushed and design.along) or lattice.tied_sides:
        return False
    several = (lattice.cells_x, lattice.cells_y) != ONE
    return several and lattice.grading == 1.0 and not any(lattice.outline)


def unit_column(design: Case) -> Case:
    """One cell of a design, as high as the design, with its walls and its mesh.

    Only a quarter of it is computed if only a quarter of the design is, and the cell allows it.
    Energies up to allowed forces are left out, since the column reaches these forces later.
    """
    lattice = design.lattice
    assert isinstance(lattice, Cells)
    cells = lattice.cells_x, lattice.cells_y
    (low, high), (left, right) = (
        extent(lattice.kind, lattice.orientation, count) for count in (cells, ONE)
    )
    width, height = (right - left) / (high - low) * (lattice.width, lattice.height)
    change: dict[str, Any] = {"cells_x": 1, "cells_y": 1, "mass": None, "infill": None}
    change |= {"width": float(width), "height": float(height)}
    cell = lattice.model_copy(update=change)
    if cell.symmetry == "quarter" and mirror_fault(cell.network):
        change["symmetry"] = "none"
    return design.changed(lattice=change, loading={"allowed_forces": ()})


def run_columns(
    designs: Sequence[Case],
    out: str | os.PathLike[str],
    how: How,
) -> DataFrame:
    """Run the missing columns of designs; return `estimates`."""
    columns = {design.case_id: unit_column(design) for design in designs}
    alone = {column.case_id: column for column in columns.values()}
    beside = file_beside(out, "screen")
    what = f"screen of {len(designs)} designs: {len(alone)} unit columns"
    run_beside(alone, beside, what, how)
    rows = read_summary(beside)
    by_id = loaded(rows).set_index("case_id", drop=False)
    return DataFrame(
        [
            _scaled(by_id.loc[column.case_id].to_dict(), design, column.lattice)
            for design, column in zip(designs, columns.values(), strict=True)
            if column.case_id in by_id.index
        ]
    )


def _scaled(row: dict[str, Any], design: Case, cell: Lattice) -> dict[str, Any]:
    """The row of a design, estimated from its column (`row`), with the id and labels of the
    design.
    """
    whole = design.lattice
    areas = [lattice.network.printed_area for lattice in (whole, cell)]
    boxes = [lattice.outer_size[0] * lattice.outer_size[1] for lattice in (whole, cell)]
    mass = areas[0] / areas[1]
    density = mass * boxes[1] / boxes[0]
    scaled = dict(row)
    for name, value in row.items():
        units = describe_column(name).units
        if units in EXTENSIVE:
            scaled[name] = mass * value
        elif units in PER_AREA:
            scaled[name] = density * value
    filled = density * row["relative_density"]
    scaled |= {"relative_density": filled, "solid_strain": 1.0 - filled}
    own = {"case_id": design.case_id, "model_version": row["model_version"]}
    return scaled | design_columns(design) | design.axes | own


def best_of(estimates: DataFrame, question: Question, count: int) -> list[str]:
    """Ids of the `count` best estimates for each infill, scene and budget of a ranking.

    If no design of an infill meets the requirements, the best ones regardless of them: the full
    model decides.
    """
    best: list[str] = []
    for _, alike in estimates.groupby("lattice_kind", sort=False):
        table = answer(alike, question._replace(top=count)).table
        if table.empty:
            table = answer(alike, question._replace(top=count, require=None)).table
        best.extend(table["case_id"])
    return [*dict.fromkeys(best)]
