"""Finds out whether a structure is a mechanism, which can move without resistance and has no
statics.

Rigid walls that share a node without a pin form one rigid body. Pins, supports, prescribed moves
and springs constrain the bodies. A motion that all of these constraints allow costs no energy.
"""

from itertools import product

import numpy as np

from sweep.array_types import Floats
from sweep.config.structures.structure import Structure, pieces_of

LOOSE = 1e-9  # share of the greatest eigenvalue below which an eigenvalue is zero
MOST = 1500  # most bodies; a structure of more is not checked here


def find_mechanism(structure: Structure) -> str:
    """A sentence with the node that moves farthest without resistance; empty if there is none.

    It is enough to look at the ends of walls, since any such motion moves one of them.
    """
    body = _bodies(structure)
    points = np.array(structure.nodes_mm) / max(structure.size_mm)
    constraints = _constraints(structure, body, points)
    n = 3 * (max(body) + 1)
    if n > 3 * MOST:
        return ""
    values, vectors = np.linalg.eigh(constraints.T @ constraints)
    loose = vectors[:, values <= LOOSE * max(values[-1], 1.0)]
    if loose.size == 0:
        return ""
    size = {
        (node, direction): float(
            np.linalg.norm(_motion(points[node], direction, body[k], n) @ loose)
        )
        for k, wall in enumerate(structure.walls)
        for node in wall
        for direction in ("x", "y")
    }
    node, direction = max(size, key=lambda place: round(size[place], 6))
    return f"node {node} can move in {direction} without resistance"


def _bodies(structure: Structure) -> list[int]:
    """Number of the body of every wall; walls that share a node without a pin are one body."""
    at: dict[int, int] = {}
    ends = [(k, node) for k, wall in enumerate(structure.walls) for node in wall]
    pairs = [(at.setdefault(node, k), k) for k, node in ends if node not in structure.pins]
    return pieces_of(len(structure.walls), pairs)


def _constraints(structure: Structure, body: list[int], points: Floats) -> Floats:
    """Prevented motions: rows (c, 3 bodies) over three unknowns of each body."""
    n = 3 * (max(body) + 1)
    meeting: dict[int, list[int]] = {}
    for k, wall in enumerate(structure.walls):
        for node in wall:
            meeting.setdefault(node, []).append(body[k])
    rows = [np.zeros(n)]
    for node, bodies in meeting.items():
        first, *others = dict.fromkeys(bodies)
        for other, direction in product(others, ("x", "y")):
            one, two = (_motion(points[node], direction, part, n) for part in (first, other))
            rows.append(one - two)
    driven = {(part.node, part.direction) for part in structure.prescribed}
    rows += [
        _motion(points[node], direction, meeting[node][0], n)
        for node, direction in structure.restraints | driven
    ]
    for a, b in (spring.nodes for spring in structure.springs):
        apart = points[b] - points[a]
        row = np.zeros(n)
        for weight, direction in zip(apart / np.linalg.norm(apart), ("x", "y"), strict=True):
            row += weight * _motion(points[b], direction, meeting[b][0], n)
            row -= weight * _motion(points[a], direction, meeting[a][0], n)
        rows.append(row)
    return np.array(rows)


def _motion(at: Floats, direction: str, body: int, n: int) -> Floats:
    """Motion of a point ``at`` on a body as a row (n,) over all unknowns.

    The unknowns of a body are its displacements at the origin and its rotation.
    """
    x, y = at
    row = np.zeros(n)
    row[3 * body : 3 * body + 3] = {"x": (1, 0, -y), "y": (0, 1, x), "rotation": (0, 0, 1)}[
        direction
    ]
    return row
