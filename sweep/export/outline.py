"""The outline of the print: the union of the walls that also gives the mass, in mm."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from sweep.constants import TO_MM
from sweep.design.network import Network
from sweep.design.panel import BEHIND, BESIDE, Panel, panel_of, too_small
from sweep.export.errors import ExportError

if TYPE_CHECKING:
    from sweep.config.kinds.specimen import Specimen
    from sweep.export.design import Design

GRID = 1e-5  # mm: vertices lie on a grid, so that single precision keeps them apart
FINE = 1e-7  # mm: the grid of the union
SLIT = 1e-3  # mm: half the width of gaps that are closed
MOST_SPECIMENS = 2_000  # placed in a panel: a minute, and files of 100 MB


class Layout(NamedTuple):
    """The printed layout: polygons and depth in mm, and numbers of specimens side by side and
    behind.
    """

    name: str
    shape: Any
    depth: float
    across: int
    behind: int
    grams: float

    @property
    def specimens(self) -> int:
        """Number of specimens."""
        return self.across * self.behind


def outline(network: Network) -> Any:
    """The union of the walls with mitred corners, a polygon in mm from the corner of its box.

    Gaps of less than twice `SLIT` are closed: round-off opens some where walls meet. Without
    `FINE`, the union of some honeycombs lacks a wall.
    """
    import shapely

    union = shapely.union_all(shapely.polygons(TO_MM * network.loops), grid_size=FINE)
    wide = shapely.buffer(union, SLIT, join_style="mitre")
    closed = shapely.buffer(wide, -SLIT, join_style="mitre")
    if pieces := shapely.get_num_geometries(closed) - 1:
        raise ExportError(f"the walls are not connected: {pieces + 1} pieces; allowed: one")
    left, low, *_ = closed.bounds
    placed = shapely.transform(closed, lambda xy: xy - (left, low))
    return shapely.set_precision(placed, GRID)


def block(lattice: Specimen) -> Any:
    """The box round a specimen, mm, which a slicer fills."""
    import shapely

    width, height = (TO_MM * side for side in lattice.outer_size)
    return shapely.box(0.0, 0.0, width, height)


def specimen(design: Design, shape: Any) -> Layout:
    """One specimen of this shape (mm)."""
    case = design.case
    return Layout(case.case_id, shape, TO_MM * case.lattice.depth, 1, 1, design.grams)


def panel(design: Design, shape: Any, sides: Sequence[float]) -> Layout:
    """The specimens that a ranking counts in a panel of two sides (m), with gaps of `BESIDE`.

    Specimens one behind the other become one, with walls as deep as all of them together, as
    nothing in the model changes along the depth; specimens that are pressed along their cells stay
    apart. Corners that stick out of the outer width, by less than half a wall, make the row wider
    by as much.
    """
    import shapely
    import shapely.affinity

    case = design.case
    filled, (width, depth) = filled_panel(design, sides), case.footprint
    for side, count, one in zip(sides, filled[:2], (width, depth), strict=True):
        if count < 1:
            raise ExportError(too_small(side, one))
    across, behind = int(filled.across), int(filled.behind)
    right, up = max(shape.bounds[2], TO_MM * width), max(shape.bounds[3], TO_MM * depth)
    gap, rows = TO_MM * BESIDE, behind if case.along else 1
    if rows * across > MOST_SPECIMENS:
        raise ExportError(
            f"a panel of {rows * across:,} specimens; allowed: at most {MOST_SPECIMENS:,}"
        )
    placed = [
        shapely.affinity.translate(shape, k * (right + gap), j * (up + gap))
        for j in range(rows)
        for k in range(across)
    ]
    whole = shapely.set_precision(shapely.multipolygons(shapely.get_parts(placed)), GRID)
    height = case.lattice.depth if case.along else filled.depth
    grams = across * behind * design.grams
    return Layout(case.case_id, whole, TO_MM * height, across, behind, grams)


def filled_panel(design: Design, sides: Sequence[float]) -> Panel:
    """The panel of a design that a ranking counts for two sides (m)."""
    gap = BEHIND[design.case.loading.direction]
    return panel_of((sides[0], sides[1]), *design.case.footprint, gap)


def rings(layout: Layout) -> list[Any]:
    """Every closed ring (n + 1, 2) of a layout, mm: outer ones anticlockwise, others clockwise."""
    import shapely

    polygons = shapely.get_parts(shapely.orient_polygons(layout.shape))
    return [shapely.get_coordinates(ring) for ring in shapely.get_rings(polygons)]
