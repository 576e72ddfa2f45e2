"""The outline of the print: the union of the walls that also gives the mass, in mm."""

from __future__ import annotations

from math import floor
from typing import TYPE_CHECKING, Any, NamedTuple

from sweep.export.errors import ExportError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sweep.config.lattice_table import Lattice
    from sweep.design.network import Network
    from sweep.export.design import Design

MM = 1e3  # per m
GRID = 1e-5  # mm: vertices lie on a grid, so that single precision keeps them apart
FINE = 1e-7  # mm: the grid of the union
SLIT = 1e-3  # mm: half the width of gaps that are no gaps
BESIDE = 0.4  # mm: least gap between two specimens of a panel; closer ones would be printed as one
ROUND_OFF = 1e-9


class Layout(NamedTuple):
    """What is printed: polygons in mm, depth in mm, and the number of specimens in it.

    specimens : also counts a depth that differs from that of the specimen.
    """

    name: str
    shape: Any
    depth: float
    specimens: float
    grams: float


def outline(network: Network) -> Any:
    """The union of the walls with mitred corners, a polygon in mm from the corner of its box.

    Gaps of less than twice `SLIT` are closed: round-off opens some where walls meet. Without
    `FINE`, the union of some honeycombs lacks a wall.
    """
    import shapely

    union = shapely.union_all(shapely.polygons(MM * network.loops), grid_size=FINE)
    wide = shapely.buffer(union, SLIT, join_style="mitre")
    closed = shapely.buffer(wide, -SLIT, join_style="mitre")
    if pieces := shapely.get_num_geometries(closed) - 1:
        raise ExportError(f"the walls do not hang together: {pieces + 1} pieces; allowed: one")
    left, low, *_ = closed.bounds
    placed = shapely.transform(closed, lambda xy: xy - (left, low))
    return shapely.set_precision(placed, GRID)


def block(lattice: Lattice) -> Any:
    """The box round a specimen, mm, which a slicer fills."""
    import shapely

    width, height = (MM * side for side in lattice.outer_size)
    return shapely.box(0.0, 0.0, width, height)


def specimen(design: Design, shape: Any) -> Layout:
    """One specimen of this shape (mm)."""
    return Layout(design.name, shape, MM * design.depth, 1.0, design.grams)


def panel(design: Design, shape: Any, sides: Sequence[float]) -> Layout:
    """A row of whole specimens along the first side, as deep as the second; sides in m.

    As in a ranking, specimens do not touch: they are spread evenly. A panel that is deeper than the
    specimen has walls as deep as it is, since nothing in the model changes along the depth.
    """
    import shapely
    import shapely.affinity

    length, depth = (MM * side for side in sides)
    width = shape.bounds[2]
    count = floor((length + BESIDE) / (width + BESIDE) + ROUND_OFF)
    if count < 1:
        raise ExportError(
            f"a panel of {length:g} mm holds no specimen, which is {width:.4g} mm wide; allowed: a "
            f"first length of {width:.4g} mm or more"
        )
    pitch = (length - width) / (count - 1) if count > 1 else 0.0
    row = [shapely.affinity.translate(shape, k * pitch) for k in range(count)]
    whole = shapely.set_precision(shapely.multipolygons(shapely.get_parts(row)), GRID)
    specimens = count * depth / (MM * design.depth)
    return Layout(design.name, whole, depth, specimens, specimens * design.grams)


def rings(layout: Layout) -> list[Any]:
    """Every closed ring (n + 1, 2) of a layout, mm: outer ones anticlockwise, others clockwise."""
    import shapely

    polygons = shapely.get_parts(shapely.orient_polygons(layout.shape))
    return [shapely.get_coordinates(ring) for ring in shapely.get_rings(polygons)]
