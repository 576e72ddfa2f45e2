"""Offset squares: courses of bricks; every second course has half a brick at either end."""

from collections.abc import Sequence

import numpy as np

from sweep.design.infill import Drawing, Floats

STAGGERED = True


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Bricks of side 1, in courses between horizontal lines."""
    joints = {row: _upright(columns, row) for row in rows}
    upright = [[[(x, row), (x, row + 1)] for x in joints[row]] for row in rows]
    lines = [np.array(walls, dtype=float) for walls in upright]
    for level in range(rows[0], rows[-1] + 2):
        x = np.union1d(joints.get(level - 1, []), joints.get(level, []))
        lines.append(np.column_stack([x, np.full(len(x), level)])[None])
    return lines


def _upright(columns: Sequence[int], row: int) -> Floats:
    """Positions in x of the vertical walls of a course."""
    ends = np.append(columns, columns[-1] + 1).astype(float)
    return ends if row % 2 == 0 else np.concatenate([ends[:1], ends[:-1] + 0.5, ends[-1:]])
