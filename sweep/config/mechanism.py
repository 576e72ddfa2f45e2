"""Whether a structure can move without resistance: it is then no matter for statics.

Walls that share a node which is no pin move together as one body, as far as they are rigid. Pins,
supports, prescribed moves and springs tie the bodies; what motion they leave costs nothing.
"""

from itertools import product

import numpy as np
from numpy.typing import NDArray

from sweep.config.structure import Structure

Floats = NDArray[np.float64]

LOOSE = 1e-9  # of the tightest tie: less is none
MOST = 1500  # bodies; for more, the question is left to the solver


def loosest(of: Structure) -> str:
    """What can move, in words; empty where everything is held.

    Any motion without resistance moves the end of a wall.
    """
    body = _bodies(of)
    points = np.array(of.nodes_mm) / max(of.size_mm)
    ties = _ties(of, body, points)
    n = 3 * (max(body) + 1)
    if n > 3 * MOST:
        return ""
    values, vectors = np.linalg.eigh(ties.T @ ties)
    loose = vectors[:, values <= LOOSE * max(values[-1], 1.0)]
    if loose.size == 0:
        return ""
    size = {
        (node, way): float(np.linalg.norm(_motion(points[node], way, body[k], n) @ loose))
        for k, wall in enumerate(of.walls)
        for node in wall
        for way in ("x", "y")
    }
    node, way = max(size, key=lambda place: round(size[place], 6))
    return f"node {node} can move in {way} without resistance"


def _bodies(of: Structure) -> list[int]:
    """The body of every wall."""
    owner = list(range(len(of.walls)))
    at: dict[int, int] = {}
    for k, wall in enumerate(of.walls):
        for node in set(wall) - set(of.pins):
            other, here = _root(owner, at.setdefault(node, k)), _root(owner, k)
            owner[max(other, here)] = min(other, here)
    roots = [_root(owner, k) for k in range(len(owner))]
    number = {root: n for n, root in enumerate(dict.fromkeys(roots))}
    return [number[root] for root in roots]


def _root(owner: list[int], k: int) -> int:
    while owner[k] != k:
        owner[k] = k = owner[owner[k]]
    return k


def _ties(of: Structure, body: list[int], points: Floats) -> Floats:
    """Motions that are prevented, rows over three unknowns a body."""
    n = 3 * (max(body) + 1)
    meeting: dict[int, list[int]] = {}
    for k, wall in enumerate(of.walls):
        for node in wall:
            meeting.setdefault(node, []).append(body[k])
    rows = [np.zeros(n)]
    for node, bodies in meeting.items():
        first, *others = dict.fromkeys(bodies)
        for other, way in product(others, ("x", "y")):
            one, two = (_motion(points[node], way, part, n) for part in (first, other))
            rows.append(one - two)
    led = {(part.node, part.direction) for part in of.prescribed}
    rows += [_motion(points[node], way, meeting[node][0], n) for node, way in of.held | led]
    for a, b in (spring.nodes for spring in of.springs):
        apart = points[b] - points[a]
        row = np.zeros(n)
        for weight, way in zip(apart / np.linalg.norm(apart), ("x", "y"), strict=True):
            row += weight * _motion(points[b], way, meeting[b][0], n)
            row -= weight * _motion(points[a], way, meeting[a][0], n)
        rows.append(row)
    return np.array(rows)


def _motion(at: Floats, way: str, body: int, n: int) -> Floats:
    """Move of a point ``at`` on a body, per unknown: the moves at the origin, and the turn."""
    x, y = at
    row = np.zeros(n)
    row[3 * body : 3 * body + 3] = {"x": (1, 0, -y), "y": (0, 1, x), "rotation": (0, 0, 1)}[way]
    return row
