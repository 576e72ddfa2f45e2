"""The printed area of a shape as polygons: walls of their true thickness, corners mitred."""

import numpy as np

from sweep.array_types import Floats, Ints

BLUNT = 0.5  # a mitre ends at most (half a thickness) / BLUNT from its node
STRAIGHT = 1e-9


def silhouette(position: Floats, edges: Ints, thickness: Floats) -> list[Floats]:
    """Closed polygons (5, 2) whose union is the shape: one per element, one per mitred corner.

    position (n, 2) and thickness (m,) in m, edges (m, 2). All polygons run anticlockwise, so that a
    non-zero winding rule fills the union.
    """
    start, end = position[edges[:, 0]], position[edges[:, 1]]
    along = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
    side = 0.5 * thickness[:, None] * _left(along)
    walls = np.stack([start - side, end - side, end + side, start + side, start - side], axis=1)
    arms = np.concatenate([along, -along])
    return [*walls, *_mitres(position, edges.T.ravel(), arms, 0.5 * np.tile(thickness, 2))]


def _mitres(position: Floats, node: Ints, arm: Floats, half: Floats) -> Floats:
    """Corners (c, 5, 2) that fill the outer sides of bends.

    One arm for each end of an element: its node (a,), its unit direction away from the node (a, 2)
    and half its thickness (a,). Two neighbouring arms of a node leave a gap if the angle between
    them exceeds half a turn. The mitre of a wall that folds back on itself is blunt.
    """
    order = np.lexsort((np.arctan2(arm[:, 1], arm[:, 0]), node))
    node, arm, half = node[order], arm[order], half[order, None]
    following = next_arm(node)
    left, right, beyond = _left(arm), -_left(arm[following]), half[following]
    one, other = half * left, beyond * right
    tip = _tip(half, beyond, (left * right).sum(1, keepdims=True), left, right)
    kites = np.stack([np.zeros_like(tip), one, tip, other, np.zeros_like(tip)], axis=1)
    gap = (left * arm[following]).sum(1) < -STRAIGHT
    return (position[node][:, None] + kites)[gap]


def _tip(one: Floats, other: Floats, cosine: Floats, left: Floats, right: Floats) -> Floats:
    """The point where two sides meet, relative to the node.

    `one` and `other` (m) are the distances of the sides from the node, along the unit normals
    `left` and `right`. If a thin wall continues a thick one nearly straight, the tip is the corner
    of the thick wall.
    """
    mean = 0.5 * (one + other) / np.maximum(1.0 + cosine, BLUNT)
    unequal = 0.5 * (one - other) / np.maximum(1.0 - cosine, STRAIGHT)
    along = np.where(mean < unequal, one, np.where(mean < -unequal, 0.0, mean + unequal))
    across = np.where(mean < unequal, 0.0, np.where(mean < -unequal, other, mean - unequal))
    return along * left + across * right


def next_arm(node: Ints) -> Ints:
    """Index of the next arm of the same ``node`` (a,); arms are sorted by node. The first arm
    follows the last.
    """
    following = np.arange(len(node)) + 1
    last = np.append(node[1:] != node[:-1], True)
    following[last] = np.searchsorted(node, node[last])
    return following


def _left(direction: Floats) -> Floats:
    """Directions (n, 2) turned left by 90 degrees."""
    return np.column_stack([-direction[:, 1], direction[:, 0]])
