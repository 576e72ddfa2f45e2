"""Turns centre lines into joints and walls: drawings are stretched to a box, clipped and welded."""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats, Ints
from sweep.design.geometry import Geometry
from sweep.design.infill import Drawing, drawer

Flags = NDArray[np.bool_]

TOLERANCE = 1e-9  # share of the box: points nearer than that are one point
FEW = 4  # cells in a row, enough to tell how numbers and sizes grow with the number of cells
SPILL = 1  # cells drawn beyond the box on each side, which an outline cuts off


class Sketch(NamedTuple):
    """A family of infill in a box (m).

    closed: with an outline on all four sides; capped: with an outline at the top and the bottom.
    """

    kind: str
    orientation: str | None
    cells: tuple[int, int]
    box: tuple[float, float]
    closed: bool = False
    capped: bool = False


def sketch(geometry: Geometry, outlined: bool = True) -> Sketch:
    """The sketch of a lattice; without ``outlined`` the sketch of its infill alone, in whole
    cells.
    """
    kind, orientation, cells, box = geometry[:4]
    if any(geometry.periodic):
        low, high = extent(kind, orientation, cells)
        whole = (high - low) / (pitch(kind, orientation) * cells)
        box = tuple(np.where(geometry.periodic, whole, 1.0) * box)
    closed, capped = (outlined and thickness > 0.0 for thickness in geometry.outline)
    return Sketch(kind, orientation, cells, box, closed, capped)


@lru_cache(maxsize=256)
def joints_and_walls(sketch: Sketch) -> tuple[Floats, Ints]:
    """Joints (j, 2) in m, row by row from the bottom, and walls (w, 2), horizontal ones first."""
    draw = drawer(sketch.kind, sketch.orientation)
    columns, rows = (range(n) for n in sketch.cells)
    if sketch.closed or sketch.capped:
        rows = range(-SPILL, len(rows) + SPILL)
    if sketch.closed:
        columns = range(-SPILL, len(columns) + SPILL)
    low, high = extent(sketch.kind, sketch.orientation, sketch.cells)
    box = np.array(sketch.box)
    tolerance = TOLERANCE * box.max()
    segments = (segments_of(draw(columns, rows)) - low) * (box / (high - low))
    segments = _snapped(segments, box, tolerance)
    if sketch.closed or sketch.capped:
        inside = np.all((segments[..., 0] >= 0.0) & (segments[..., 0] <= box[0]), axis=1)
        segments = segments if sketch.closed else segments[inside]
        segments = with_outline(segments, box, [sketch.closed, True])
    points, walls = welded(segments, tolerance)
    points.flags.writeable = walls.flags.writeable = False
    return points, walls


@lru_cache(maxsize=256)
def extent(kind: str, orientation: str | None, cells: tuple[int, int]) -> tuple[Floats, Floats]:
    """Least and greatest x and y, (2,) each, of whole cells, in the unit of the family.

    More than two rows are as wide as two, and more than two columns as high as two.
    """
    draw, (columns, rows) = drawer(kind, orientation), cells
    wide = segments_of(draw(range(columns), range(min(rows, 2))))[..., 0]
    high = segments_of(draw(range(min(columns, 2)), range(rows)))[..., 1]
    return np.array([wide.min(), high.min()]), np.array([wide.max(), high.max()])


def pitch(kind: str, orientation: str | None) -> Floats:
    """Width and height (2,) of a regular cell, in the unit of its family.

    They are half of the extent that two more cells add.
    """
    (low, high), (less, more) = (extent(kind, orientation, (n, n)) for n in (FEW, FEW + 2))
    return 0.5 * ((more - less) - (high - low))


@lru_cache(maxsize=256)
def counts(sketch: Sketch) -> tuple[int, int]:
    """Numbers of joints and walls, without drawing all of them.

    Both are linear in the number of columns and of rows, among numbers of equal parity.
    """
    for axis, n in enumerate(sketch.cells):
        if n > FEW + 3:
            few = FEW + n % 2
            one, two = (counts(_with_cells(sketch, axis, k)) for k in (few, few + 2))
            joints, walls = (a + (b - a) * (n - few) // 2 for a, b in zip(one, two, strict=True))
            return joints, walls
    drawn = joints_and_walls(sketch)
    return len(drawn[0]), len(drawn[1])


def sample(sketch: Sketch) -> Sketch:
    """The sketch with at most `FEW` columns and rows of the same cells."""
    for axis, n in enumerate(sketch.cells):
        if n > FEW:
            sketch = _with_cells(sketch, axis, FEW)
    return sketch


def _with_cells(sketch: Sketch, axis: int, n: int) -> Sketch:
    """A sketch with ``n`` columns (axis 0) or rows of the same cells."""
    columns, rows = sketch.cells
    cells = (n, rows) if axis == 0 else (columns, n)
    (low, high), (less, more) = (
        extent(sketch.kind, sketch.orientation, some) for some in (sketch.cells, cells)
    )
    width, height = np.array(sketch.box) * (more - less) / (high - low)
    return sketch._replace(cells=cells, box=(float(width), float(height)))


def on_outline(points: Floats, walls: Ints, side: float, axis: int) -> Flags:
    """Which walls lie on the line x (axis 0) or y (axis 1) = ``side``, (w,)."""
    on: Flags = np.all(points[walls][..., axis] == side, axis=1)
    return on


def outer_rows(points: Floats) -> tuple[Ints, Ints]:
    """The joints of least and of greatest y."""
    y = points[:, 1]
    return np.flatnonzero(y == y.min()), np.flatnonzero(y == y.max())


def segments_of(drawing: Drawing) -> Floats:
    """All segments of all polylines, (s, 2, 2)."""
    pieces = [np.stack([lines[:, :-1], lines[:, 1:]], axis=2) for lines in drawing]
    return np.concatenate([piece.reshape(-1, 2, 2) for piece in pieces])


def _snapped(segments: Floats, box: Floats, tolerance: float) -> Floats:
    """Segments whose coordinates near the sides of the box are exactly on them."""
    for line in (np.zeros(2), box):
        segments = np.where(np.abs(segments - line) < tolerance, line, segments)
    return segments


def with_outline(segments: Floats, box: Floats, axes: Sequence[bool]) -> Floats:
    """Segments clipped at the sides of the box, and these sides; ``axes``: in x, in y.

    The outline has joints at its corners and wherever a segment ends on it.
    """
    tolerance = TOLERANCE * box.max()
    segments = _snapped(clipped(segments, box, axes), box, tolerance)
    lines = [(axis, side) for axis in (0, 1) if axes[axis] for side in (0.0, box[axis])]
    outline = []
    for axis, side in lines:
        ends = segments[..., axis] == side
        along = np.append(segments[ends][:, 1 - axis], [0.0, box[1 - axis]])
        at, _ = clusters(along, tolerance)
        outline.append(pieces(at, side, axis))
    return np.concatenate([segments, *outline])


def pieces(at: Floats, side: float, axis: int) -> Floats:
    """Segments between places ``at`` (k,) on the line x (axis 0) or y = ``side``, (k - 1, 2, 2)."""
    line = np.full((len(at), 2), side)
    line[:, 1 - axis] = at
    return np.stack([line[:-1], line[1:]], axis=1)


def clipped(segments: Floats, box: Floats, axes: Sequence[bool]) -> Floats:
    """The parts of segments inside the box, without segments that lie on its sides."""
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    enter, leave = np.zeros(len(segments)), np.ones(len(segments))
    for axis in np.flatnonzero(axes):
        with np.errstate(divide="ignore", invalid="ignore"):
            one, two = ((side - start[:, axis]) / along[:, axis] for side in (0.0, box[axis]))
        enter, leave = np.maximum(enter, np.fmin(one, two)), np.minimum(leave, np.fmax(one, two))
    inside = (leave - enter) * np.linalg.norm(along, axis=1) > TOLERANCE * box.max()
    share = np.column_stack([enter, leave])[inside]
    return start[inside, None] + share[..., None] * along[inside, None]


def welded(segments: Floats, tolerance: float) -> tuple[Floats, Ints]:
    """Joints (j, 2) and walls (w, 2) of segments, duplicates removed."""
    points, ends = distinct(segments, tolerance)
    walls = np.unique(np.sort(ends, axis=1), axis=0)
    level = points[walls[:, 0], 1] == points[walls[:, 1], 1]
    return points, walls[np.argsort(~level, kind="stable")]


def distinct(segments: Floats, tolerance: float) -> tuple[Floats, Ints]:
    """The ends of segments (s, 2, 2) as joints (j, 2), row by row from the bottom, and the joints
    of each, (s, 2).
    """
    x, column = clusters(segments[..., 0].ravel(), tolerance)
    y, row = clusters(segments[..., 1].ravel(), tolerance)
    joint, end = np.unique(row * len(x) + column, return_inverse=True)
    points = np.column_stack([x[joint % len(x)], y[joint // len(x)]])
    return points, end.reshape(-1, 2)


def connected(pairs: Ints, count: int) -> Ints:
    """The group of each of ``count`` points, (count,), of which ``pairs`` (k, 2) are connected."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(count, count))
    _, group = connected_components(graph, directed=False)
    return np.asarray(group)


def clusters(values: Floats, tolerance: float) -> tuple[Floats, Ints]:
    """The distinct values, ascending, and the index of each value among them."""
    order = np.argsort(values, kind="stable")
    new = np.diff(values[order], prepend=-np.inf) > tolerance
    which = np.empty(len(values), np.int64)
    which[order] = np.cumsum(new) - 1
    return values[order][new], which
