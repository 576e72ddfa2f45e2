"""The printed area of a shape as polygons: walls as thick as they are, corners mitred."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

BLUNT = 0.5  # a mitre reaches at most half a thickness / BLUNT from its node
STRAIGHT = 1e-9


def silhouette(position: Floats, edges: Integers, thickness: Floats) -> list[Floats]:
    """Closed polygons (5, 2) whose union is the shape: one an element, one where walls bend.

    position (n, 2), edges (m, 2), thickness (m,). All turn anticlockwise, so that a non-zero
    winding rule fills the union.
    """
    start, end = position[edges[:, 0]], position[edges[:, 1]]
    along = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
    side = 0.5 * thickness[:, None] * _left(along)
    walls = np.stack([start - side, end - side, end + side, start + side, start - side], axis=1)
    arms = np.concatenate([along, -along])
    return [*walls, *_mitres(position, edges.T.ravel(), arms, 0.5 * np.tile(thickness, 2))]


def _mitres(position: Floats, node: Integers, arm: Floats, half: Floats) -> Floats:
    """Corners (c, 5, 2) that fill the outer sides of bends.

    node (a,), arm (a, 2), half (a,): every end of an element, its direction away from the node and
    half its thickness. Round a node, an arm and the next one leave a gap where they are more than
    half a turn apart. Where a wall folds back on itself the mitre is blunt.
    """
    order = np.lexsort((np.arctan2(arm[:, 1], arm[:, 0]), node))
    node, arm, half = node[order], arm[order], half[order, None]
    following = _following(node)
    left, right, beyond = _left(arm), -_left(arm[following]), half[following]
    one, other = half * left, beyond * right
    tip = _tip(half, beyond, (left * right).sum(1, keepdims=True), left, right)
    kites = np.stack([np.zeros_like(tip), one, tip, other, np.zeros_like(tip)], axis=1)
    gap = (left * arm[following]).sum(1) < -STRAIGHT
    return (position[node][:, None] + kites)[gap]


def _tip(one: Floats, other: Floats, cosine: Floats, left: Floats, right: Floats) -> Floats:
    """Where two sides meet that are `one` and `other` away from a node, along unit normals.

    A thin wall that leaves a thick one nearly straight ends within its corner.
    """
    mean = 0.5 * (one + other) / np.maximum(1.0 + cosine, BLUNT)
    unlike = 0.5 * (one - other) / np.maximum(1.0 - cosine, STRAIGHT)
    along = np.where(mean < unlike, one, np.where(mean < -unlike, 0.0, mean + unlike))
    across = np.where(mean < unlike, 0.0, np.where(mean < -unlike, other, mean - unlike))
    return along * left + across * right


def _following(node: Integers) -> Integers:
    """For arms in groups of one node each, the next arm of the group; after the last, the first."""
    following = np.arange(len(node)) + 1
    last = np.append(node[1:] != node[:-1], True)
    following[last] = np.searchsorted(node, node[last])
    return following


def _left(direction: Floats) -> Floats:
    """Directions (n, 2) turned left by a quarter."""
    return np.column_stack([-direction[:, 1], direction[:, 0]])
