"""The plan of upright walls, which are pressed along their cells: its quads, its bow, its quarter.

A network is even if all its closed paths have an even number of walls. Equal walls between joints
of an even network buckle so that all arms of a joint turn alike and the arms of neighbouring joints
turn oppositely. Half a wave is then as long as a wall.
"""

from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.design.drawing import connected
from sweep.design.network import Network

NEAR = 1e-9  # share of the size of the plan: points nearer than that are one point
ROUND_OFF = 1e-9


class Plan(NamedTuple):
    """Centre lines of upright walls, or the quarter of them at the least x and y.

    points (j, 2): joints, then ends of walls on a mirror plane, m. walls (w, 2): a wall that a
    mirror plane cuts ends there. thickness (w,), m. span (w,): length of the whole wall, m. sign
    (w,): to which side of its direction a wall bows when it buckles, 1: to the right. planes (2,):
    x and y of the mirror planes, m; infinite without. on (j, 2): which points are on each of them.
    """

    points: Floats
    walls: Ints
    thickness: Floats
    span: Floats
    sign: Ints
    planes: Floats
    on: np.ndarray

    @property
    def length(self) -> Floats:
        """Length of every wall in the plan, (w,) m."""
        start, end = self.points[self.walls].swapaxes(0, 1)
        return np.asarray(np.linalg.norm(end - start, axis=1))


def plan_of(network: Network, quarter: bool = False) -> Plan:
    """The plan of a network, or its quarter; ValueError if it has none (`mirror_fault`)."""
    points, walls = network.points, network.walls
    sign = turns(len(points), walls)[walls[:, 0]]
    whole = Plan(
        points, walls, network.wall_thickness, network.length, sign,
        np.full(2, np.inf), np.zeros((len(points), 2), np.bool_),
    )  # fmt: skip
    if not quarter:
        return whole
    if fault := mirror_fault(network):
        raise ValueError(fault)
    return _quarter(whole)


def quads_along(plan: Plan, most: int | Ints) -> Ints:
    """Number of equal quads along each wall, (w,): ``most`` (one number or (w,)) in a whole wall.

    A wall that a mirror plane cuts has half of them, rounded up. No quad is shorter than the wall
    is thick, except that a wall that is itself shorter has one quad.
    """
    share = plan.length / plan.span
    count = np.ceil(share * np.asarray(most) - ROUND_OFF)
    fit = np.floor(plan.length / plan.thickness * (1.0 + ROUND_OFF))
    return np.asarray(np.clip(count, 1, np.maximum(fit, 1)), np.int64)


def layers_of(plan: Plan, along: Ints, height: float) -> int:
    """Number of layers of quads that are as high as the mean quad is long (``along``:
    `quads_along`), and no lower than the thickest wall; `height` in m.
    """
    mean = plan.length.sum() / along.sum()
    return int(np.clip(round(height / mean), 1, max(most_layers(plan.thickness, height), 1)))


def most_layers(thickness: Floats, height: float) -> int:
    """Number of layers of quads as low as the thickest wall, `thickness` (w,) m, in a height, m."""
    return int(height / thickness.max() * (1.0 + ROUND_OFF))


def turns(joints: int, walls: Ints) -> Ints:
    """1 or -1 for each joint, (j,): how it turns as equal walls buckle.

    Neighbours turn oppositely; if closed paths have an odd number of walls this is not possible for
    all of them, and the number of walls to the first joint decides.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import dijkstra

    graph = csr_array((np.ones(len(walls)), walls.T), shape=(joints, joints))
    _, first = np.unique(connected(walls, joints), return_index=True)
    away = dijkstra(graph, directed=False, indices=first, unweighted=True, min_only=True)
    return 1 - 2 * (away.astype(np.int64) % 2)


def mirror_fault(network: Network) -> str:
    """Why a network cannot be cut at its two middle planes, as a clause; empty if it can.

    Its drawing must be symmetric, and so must be the shape in which its walls buckle: a joint and
    its image turn oppositely.
    """
    points, walls = network.points, network.walls
    turn = turns(len(points), walls)
    for axis in (0, 1):
        image = _images(points, axis)
        if image is None or not _same_walls(network, image):
            return "the drawing is not symmetric about its middle"
        if np.any(image == np.arange(len(points))):
            return "joints lie on its middle planes, and could not turn there as walls buckle"
        if np.any(turn[image] != -turn):
            return "its walls do not buckle symmetrically about its middle"
    return ""


def _images(points: Floats, axis: int) -> Ints | None:
    """The point at the mirror image of each point; None if a point has none."""
    from scipy.spatial import KDTree

    mirrored = points.copy()
    mirrored[:, axis] = points[:, axis].min() + points[:, axis].max() - points[:, axis]
    apart, image = KDTree(points).query(mirrored)
    return np.asarray(image) if apart.max() <= NEAR * np.ptp(points) else None


def _same_walls(network: Network, image: Ints) -> bool:
    """Whether the image of every wall is a wall of the same thickness."""
    own = {
        (*sorted(wall), round(thickness / network.wall_thickness.max(), 9))
        for wall, thickness in zip(network.walls.tolist(), network.wall_thickness, strict=True)
    }
    mirrored = {(*sorted(image[list(pair)].tolist()), thickness) for *pair, thickness in own}
    return own == mirrored


def _quarter(whole: Plan) -> Plan:
    """The part of a plan at the least x and y; walls that cross a plane begin at their joint."""
    low, high = whole.points.min(axis=0), whole.points.max(axis=0)
    planes = 0.5 * (low + high)
    inside = np.all(whole.points < planes, axis=1)
    start, end = inside[whole.walls].T
    turned = ~start & end
    walls = np.where(turned[:, None], whole.walls[:, ::-1], whole.walls)
    sign = np.where(turned, turns(len(whole.points), whole.walls)[walls[:, 0]], whole.sign)
    kept = start | end
    cut = np.flatnonzero(start ^ end)
    points, ends = whole.points, whole.points[walls[cut]]
    across = np.argmax(np.abs(ends[:, 1] - ends[:, 0]), axis=1)
    middle = ends.mean(axis=1)
    on = np.zeros((len(points) + len(cut), 2), np.bool_)
    on[len(points) + np.arange(len(cut)), across] = True
    walls[cut, 1] = len(points) + np.arange(len(cut))
    points = np.concatenate([points, middle])
    used, number = np.unique(walls[kept], return_inverse=True)
    return Plan(
        points[used], number.reshape(-1, 2), whole.thickness[kept], whole.span[kept], sign[kept],
        planes, on[used],
    )  # fmt: skip
