"""Whether a structure can move without resistance: the null space of its stiffness at rest."""

import numpy as np

from sweep.custom import Structure

WAYS = ("x", "y", "rotation")
LOOSE = 1e-9  # of the greatest stiffness: less is none


def loosest(of: Structure) -> str:
    """What can move, in words; empty where supports and walls hold everything.

    The stiffness of unit walls, axial and bending, with releases at pins; springs are axial. Three
    unknowns a node, the rotation times the mean length of a wall.
    """
    points = np.array(of.nodes_mm)
    n = len(points)
    walls = np.array(of.walls)
    along = points[walls[:, 1]] - points[walls[:, 0]]
    unit = np.linalg.norm(along, axis=1).mean()
    modes = [_axial(a, b, points, n) for a, b in (*of.walls, *(s.nodes for s in of.springs))]
    for a, b in of.walls:
        modes += _bending(a, b, points, n, unit, of.pins)
    kinematic = np.array(modes)
    held = {3 * node + WAYS.index(way) for node, way in of.held}
    held |= {3 * p.node + WAYS.index(p.direction) for p in of.prescribed}
    held |= {3 * node + 2 for node in of.pins}
    free = np.setdiff1d(np.arange(3 * n), list(held))
    if free.size == 0:
        return ""
    reduced = kinematic[:, free]
    values, vectors = np.linalg.eigh(reduced.T @ reduced)
    loose = vectors[:, values <= LOOSE * values[-1]]
    if loose.size == 0:
        return ""
    size = np.zeros(3 * n)
    size[free] = np.linalg.norm(loose, axis=1)
    at = int(size.round(6).argmax())
    way = ("move in x", "move in y", "turn")[at % 3]
    return f"node {at // 3} can {way} without resistance"


def _axial(a: int, b: int, points: np.ndarray, n: int) -> np.ndarray:
    """How much a bar from a to b lengthens, per unknown, (3 n,)."""
    direction = (points[b] - points[a]) / np.linalg.norm(points[b] - points[a])
    row = np.zeros(3 * n)
    row[3 * a : 3 * a + 2], row[3 * b : 3 * b + 2] = -direction, direction
    return row


def _bending(
    a: int, b: int, points: np.ndarray, n: int, unit: float, pins: tuple[int, ...]
) -> list[np.ndarray]:
    """Turns of the rigid ends of a wall against its chord, per unknown; none at pins."""
    vector = points[b] - points[a]
    length = float(np.linalg.norm(vector))
    normal = np.array([-vector[1], vector[0]]) / length
    rows = []
    for node in (a, b):
        if node not in pins:
            row = np.zeros(3 * n)
            row[3 * a : 3 * a + 2], row[3 * b : 3 * b + 2] = (
                -normal * unit / length,
                normal * unit / length,
            )
            row[3 * node + 2] -= 1.0
            rows.append(row)
    return rows
