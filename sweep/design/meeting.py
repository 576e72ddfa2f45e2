"""Turns the lines of any drawing into joints and walls: they meet where they cross, touch or
overlap.

The lines of an infill have vertices where they meet (`drawing.welded`), and a slicer's lines end on
its outline (`slicer.joining`); the lines of a drawing may lie anywhere. Points that are nearer to
one another than `NEAR` become one point, the point of the line that is drawn first; a point that is
so near to a line is on it.
"""

from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.design.drawing import connected

NEAR = 1e-4  # share of the greater side of the drawing
FAR = 10.0  # greatest move of a point / `NEAR`
ROUND_OFF = 1e-9  # share of the same side
ROUNDS = 20  # rounds in which lines that move by `NEAR` may meet others
CHUNK = 256  # number of lines whose crossings are found at a time
MOST_JOINTS = 50_000


class MeetingError(ValueError):
    """Lines that make no network of walls; the text says why."""


class Meeting(NamedTuple):
    """joints (j, 2) from the lower left corner, row by row from the bottom; walls (w, 2): their
    joints; line (w,): the line that each wall is part of.
    """

    joints: Floats
    walls: Ints
    line: Ints


def met(lines: Floats) -> Meeting:
    """The network of straight lines (s, 2, 2); where some overlap, the wall belongs to the last of
    them.

    Raises `MeetingError` if lines have more than `MOST_JOINTS` joints, or a chain of points so
    close to one another that all of them would become one.
    """
    near = NEAR * float(np.ptp(lines, axis=(0, 1)).max())
    line = np.arange(len(lines))
    points, walls, line = _merged(lines.reshape(-1, 2), line, near)
    for _ in range(ROUNDS):
        count, crossings = len(walls), _crossings(points, walls)
        pieces, piece_of = _split(np.concatenate([points, crossings]), walls, near)
        points, walls, line = _merged(pieces, line[piece_of], near)
        if len(walls) == count:
            return _in_rows(points, walls, line, near)
    raise MeetingError(f"its lines do not come to meet in {ROUNDS} rounds: too many are too close")


def _merged(ends: Floats, line: Ints, near: float) -> tuple[Floats, Ints, Ints]:
    """Distinct points, walls between them, and their lines, of the ends (2 s, 2) of lines.

    Walls without length and all but the last of equal walls are left out.
    """
    from scipy.spatial import KDTree

    pairs = KDTree(ends).query_pairs(near, output_type="ndarray")
    group = connected(pairs, len(ends))
    _, first, number = np.unique(group, return_index=True, return_inverse=True)
    points = ends[first]
    moved = np.abs(points[number] - ends).max(axis=1)
    if moved.max() > FAR * near:
        x, y = ends[moved.argmax()]
        raise MeetingError(
            f"near {x:.5g}, {y:.5g} points follow one another more closely than {near:.3g}, so "
            "that they would all be one"
        )
    walls = np.sort(number.reshape(-1, 2), axis=1)
    apart = walls[:, 0] != walls[:, 1]
    walls, line = walls[apart][::-1], line[apart][::-1]
    walls, last = np.unique(walls, axis=0, return_index=True)
    used, renumbered = np.unique(walls, return_inverse=True)
    return points[used], renumbered.reshape(-1, 2), line[last]


def _crossings(points: Floats, walls: Ints) -> Floats:
    """Where walls without a common joint cross, (k, 2)."""
    import shapely

    ends = points[walls]
    shapes = shapely.linestrings(ends)
    tree, contacts, count = shapely.STRtree(shapes), [], 0
    for start in range(0, len(walls), CHUNK):
        one, two = tree.query(shapes[start : start + CHUNK], predicate="intersects")
        one += start
        kept = (one < two) & ~(walls[one][:, :, None] == walls[two][:, None, :]).any(axis=(1, 2))
        contacts.append(_crossing(ends[one[kept]], ends[two[kept]]))
        count += len(contacts[-1])
        if count > MOST_JOINTS:
            raise MeetingError(f"its lines cross more than {MOST_JOINTS:,} times")
    return np.concatenate(contacts)


def _crossing(one: Floats, two: Floats) -> Floats:
    """Points where pairs of lines (k, 2, 2) cross; parallel ones meet only at their ends."""
    u, v, apart = one[:, 1] - one[:, 0], two[:, 1] - two[:, 0], two[:, 0] - one[:, 0]
    turn, share = _cross(u, v), _cross(apart, v)
    steep = np.abs(turn) > 1e-12 * np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1)
    share = share[steep] / turn[steep]
    return one[steep, 0] + np.clip(share, 0.0, 1.0)[:, None] * u[steep]


def _cross(u: Floats, v: Floats) -> Floats:
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def _split(points: Floats, walls: Ints, near: float) -> tuple[Floats, Ints]:
    """Ends (2 p, 2) of the pieces of walls between all points on them, and the wall of each piece.

    Points up to ``near`` from a wall are moved onto it; if there are several walls, onto the first.
    """
    import shapely

    shapes = shapely.linestrings(points[walls])
    pairs = shapely.STRtree(shapes).query(shapely.points(points), "dwithin", near)
    point, wall = np.concatenate([pairs, [walls.T.ravel(), np.tile(np.arange(len(walls)), 2)]], 1)
    start, end = points[walls[wall]].swapaxes(0, 1)
    along = np.einsum("ij,ij->i", points[point] - start, end - start)
    along /= np.einsum("ij,ij->i", end - start, end - start)
    along[point == walls[wall, 0]], along[point == walls[wall, 1]] = 0.0, 1.0
    inside = np.flatnonzero((along >= 0.0) & (along <= 1.0))
    inside = inside[np.lexsort([along[inside], wall[inside]])]
    point, wall, along = point[inside], wall[inside], along[inside]
    between = np.flatnonzero((along > 0.0) & (along < 1.0))[::-1]
    on_wall = start[inside] + along[:, None] * (end - start)[inside]
    points[point[between]] = on_wall[between]
    same = wall[1:] == wall[:-1]
    ends = np.column_stack([point[:-1], point[1:]])[same]
    return points[ends.ravel()], wall[:-1][same]


def _in_rows(points: Floats, walls: Ints, line: Ints, near: float) -> Meeting:
    """The network with its joints row by row from the bottom, and its walls in their order.

    Coordinates are rounded, so that joints of a row have equal ones. Joints within ``near`` of the
    lowest or the highest joint are in one row with it.
    """
    digit = near * ROUND_OFF / NEAR
    points = np.rint((points - points.min(axis=0)) / digit) * digit
    for row in (points[:, 1].min(), points[:, 1].max()):
        points[np.abs(points[:, 1] - row) < near, 1] = row
    order = np.lexsort(points.T)
    walls = np.sort(np.argsort(order)[walls], axis=1)
    sequence = np.lexsort(walls.T[::-1])
    return Meeting(points[order], walls[sequence], line[sequence])
