"""Joins lines of infill to the outline that the perimeters of a slicer draw.

The outline is a rectangle that never moves: its corners stay, and joints move along its sides. If
the opening between a joint of the infill and the outline is less than a line, the joint is moved to
the outline; places on the outline that are as near to one another become one. Such places may
follow each other round the whole outline, so that the distance of parallel lines limits which
become one.
"""

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats, Ints
from sweep.design.drawing import TOLERANCE, connected, pieces, welded, with_outline

Mask = NDArray[np.bool_]


def joined(lines: Floats, box: Floats, least: float, apart: float) -> tuple[Floats, Ints]:
    """Joints (j, 2) and walls (w, 2) of lines (s, 2, 2) in a box and of its outline; all in m.

    No wall of the infill that ends on the outline is shorter than ``least``, and no piece of the
    outline, except where joints as far from one another as ``apart`` would become one.
    """
    least, apart = (1.0 - TOLERANCE) * least, min(apart, box.min())
    ends = with_outline(lines, box, [True, True])
    while True:  # every round leaves fewer joints, or is the last
        points, walls = welded(ends, TOLERANCE * box.max())
        ends = points[walls]
        beside = _on_outline(ends, box).any(axis=1)
        placed = _placed(points, walls[beside & (_length(ends) < least)], box, apart)
        if (placed == points).all():
            return points, walls
        ends = _framed(placed[walls], box, least)


def _placed(points: Floats, short: Ints, box: Floats, apart: float) -> Floats:
    """The points, with the ends of each of the ``short`` walls (k, 2) at one place.

    In groups as wide as ``apart`` joints of the infill are moved to the outline one by one; when
    none of them is left, the longest walls of such groups stay.
    """
    inner, outer = np.concatenate([short, short[:, ::-1]]).T
    group, wide = _groups(points, short, box, apart)
    on = _on_outline(points, box)
    alone = wide[inner] & ~on[inner] & on[outer]
    if alone.any():
        middle = _middles(points, box, inner[alone], outer[alone])
        return np.where(np.isnan(middle), points, middle)
    while wide.any():
        length = _length(points[short])
        longest = np.zeros(len(points))
        np.maximum.at(longest, group[short[:, 0]], (1.0 - TOLERANCE) * length)
        short = short[~wide[short[:, 0]] | (length < longest[group[short[:, 0]]])]
        group, wide = _groups(points, short, box, apart)
    return _middles(points, box, group, np.arange(len(points)))[group]


def _groups(points: Floats, short: Ints, box: Floats, apart: float) -> tuple[Ints, Mask]:
    """The group of every point, connected by ``short`` walls, and whether its joints on the outline
    are as far from one another as ``apart``, in width or height.
    """
    group = connected(short, len(points))
    on = _on_outline(points, box)
    low, high = np.full_like(points, np.inf), np.full_like(points, -np.inf)
    np.minimum.at(low, group[on], points[on])
    np.maximum.at(high, group[on], points[on])
    wide: Mask = np.any(high - low >= apart, axis=1)
    return group, wide[group]


def _middles(points: Floats, box: Floats, owner: Ints, member: Ints) -> Floats:
    """The middle of the points ``member`` (k,) of each ``owner`` (k,), (n, 2); NaN without a point.

    It is at a corner of the box or on a side if one of the points is there; for points on two sides
    it is the corner between them.
    """
    fixed = ((points == 0.0) | (points == box)).sum(axis=1)[member]  # 2: a corner, 1: on a side
    most = np.zeros(len(points), np.int64)
    np.maximum.at(most, owner, fixed)
    leads = fixed == most[owner]
    owner, member = owner[leads], member[leads]
    count = np.bincount(owner, minlength=len(points)).astype(float)
    count[count == 0.0] = np.nan
    middle = np.empty_like(points)
    for axis in (0, 1):
        place = points[member, axis]
        middle[:, axis] = np.bincount(owner, place, len(points)) / count
        for side in (0.0, box[axis]):
            middle[owner[place == side], axis] = side
    return middle


def _framed(ends: Floats, box: Floats, least: float) -> Floats:
    """The walls of the infill among walls (w, 2, 2), and the outline that they end on.

    Walls that became points are left out, and walls shorter than ``least`` across a corner. Joints
    of the outline at which no wall ends any more stay if its pieces are not shorter than that.
    """
    along = ((ends[:, 0] == ends[:, 1]) & ((ends[:, 0] == 0.0) | (ends[:, 0] == box))).any(axis=1)
    across = _on_outline(ends, box).all(axis=1)
    lines = ends[~along & ~(across & (_length(ends) < least)) & (_length(ends) > 0.0)]
    outline = []
    for axis in (0, 1):
        corners = [0.0, box[1 - axis]]
        for side in (0.0, box[axis]):
            at = np.unique(np.append(ends[ends[..., axis] == side][:, 1 - axis], corners))
            needed = np.append(lines[lines[..., axis] == side][:, 1 - axis], corners)
            gap = np.minimum(np.diff(at, prepend=-np.inf), np.diff(at, append=np.inf))
            at = at[np.isin(at, needed) | (gap >= least)]
            outline.append(pieces(at, side, axis))
    return np.concatenate([lines, *outline])


def _on_outline(points: Floats, box: Floats) -> Mask:
    """Which points (..., 2) are on a side of the box."""
    on: Mask = ((points == 0.0) | (points == box)).any(axis=-1)
    return on


def _length(ends: Floats) -> Floats:
    """Lengths of walls (w, 2, 2), m."""
    length: Floats = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return length
