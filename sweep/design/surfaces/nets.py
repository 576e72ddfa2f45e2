"""A net of quads on a level surface between two planes: surface nets, then smoothed.

A grid of cells covers one box of the surface. Every cell that the surface passes through has one
node, every edge of the grid that the surface cuts one quad between the four cells round it (S.
Gibson, Constrained elastic surface nets, 1998). The nodes then move along the surface towards the
means of their neighbours. So there are quads only, of nearly equal size.

The box repeats along x and y. It ends at the planes z = 0 and z = height: the cells of the outer
layers are centred on these, and their nodes are moved along the surface to the curves in which it
meets the planes.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from sweep.design.surfaces.level_set import Floats, LevelSet

Ints = NDArray[np.int64]

ROUNDS = 30  # of smoothing
STRIDE = 0.5  # share of the way to the mean of the neighbours, in a round
NEWTON = 4  # steps back to the surface after a move
LONGEST = 0.3  # such a step, in cells
GOOD = 0.3  # `Net.quality`
MORE = sorted(product(range(3), repeat=3), key=sum)  # cells
PLACES = tuple(product((0.13, 0.63), repeat=2))  # of the box, in cells
AROUND = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])  # cells round an edge, from the last of these


@dataclass(frozen=True)
class Box:
    """The part of a level surface that repeats, in its own axes.

    size (3,): periods along x and y, and the height, m. phase (3, 3): phases by coordinates in
    1/m; its columns are orthogonal. origin (3,): phases at the corner of the box.
    """

    surface: LevelSet
    size: Floats
    phase: Floats
    origin: Floats

    def value(self, points: Floats) -> Floats:
        """The function at points (n, 3) in m."""
        return self.surface.value(points @ self.phase.T + self.origin)

    def gradient(self, points: Floats) -> Floats:
        """Its gradient (n, 3) in 1/m."""
        return self.surface.gradient(points @ self.phase.T + self.origin) @ self.phase


@dataclass(frozen=True)
class Net:
    """A net of quads on the surface of a ``box``; n nodes.

    points (n, 3): m. quads (m, 4): nodes in order round each quad, its normal to the side of the
    gradient. shift (m, 4, 2): by how many periods the corner of a quad is moved along x and y from
    the node. bottom, top: nodes on the planes.
    """

    box: Box
    points: Floats
    quads: Ints
    shift: Ints
    bottom: Ints
    top: Ints

    @cached_property
    def normals(self) -> Floats:
        """Unit normals of the surface at the nodes, (n, 3)."""
        return _unit(self.box.gradient(self.points))

    @cached_property
    def corners(self) -> Floats:
        """Positions of the corners of the quads, (m, 4, 3) in m."""
        at = self.points[self.quads]
        at[..., :2] += self.shift * self.box.size[:2]
        return at

    @cached_property
    def quality(self) -> float:
        """The least, over all corners, of the area of its two sides over the squared mean side: 1
        in a net of squares.
        """
        ahead = np.roll(self.corners, -1, axis=1) - self.corners
        areas = np.linalg.norm(np.cross(ahead, -np.roll(ahead, 1, axis=1)), axis=2)
        return float(areas.min() / np.mean(np.linalg.norm(ahead, axis=2)) ** 2)

    @cached_property
    def directions(self) -> Floats:
        """Unit normals of the quads in their middles, (m, 3)."""
        at = self.corners
        return _unit(np.cross(at[:, 2] - at[:, 0], at[:, 3] - at[:, 1]))

    @cached_property
    def area(self) -> Floats:
        """Area of each quad, of the triangles between its sides and its centre, (m,) m^2."""
        centre = self.corners.mean(axis=1, keepdims=True)
        arms = self.corners - centre
        parts = np.cross(arms, np.roll(arms, -1, axis=1))
        return np.asarray(0.5 * np.linalg.norm(parts, axis=2).sum(axis=1))


def best_net(box: Box, cells: tuple[int, int, int]) -> Net:
    """The first net of `GOOD` quads, else the best one, on a grid of about so many cells.

    How a grid lies on the surface decides which quads meet at a node, and so how slender some of
    them are. Nothing else changes if the box moves along x and y; up to two more cells along each
    axis are tried, too.
    """
    best = None
    for more in MORE:
        grid = (cells[0] + more[0], cells[1] + more[1], cells[2] + more[2])
        for x, y in PLACES:
            start = box.phase[:, :2] @ (np.array([x, y]) * box.size[:2] / np.array(grid[:2]))
            net = build_net(replace(box, origin=box.origin + start), grid)
            if net.quality > GOOD:
                return net
            if best is None or net.quality > best.quality:
                best = net
    assert best is not None
    return best


def build_net(box: Box, cells: tuple[int, int, int]) -> Net:
    """A net of ``box`` on a grid of so many cells along x, y and z."""
    value = _grid_values(box, cells)
    inside = value > 0.0
    quads = np.concatenate([_quads(inside, cells, axis) for axis in range(3)])
    cell = quads[..., 2] * cells[0] * cells[1]
    cell += (quads[..., 1] % cells[1]) * cells[0] + quads[..., 0] % cells[0]
    shift = quads[..., :2] // np.array(cells[:2])
    used, corner = np.unique(cell, return_inverse=True)
    layer = used // (cells[0] * cells[1])
    place = np.column_stack([used % cells[0] + 0.5, used // cells[0] % cells[1] + 0.5, layer])
    step = box.size / np.array(cells)
    net = Net(
        box, place * step, corner.reshape(-1, 4), shift,
        np.flatnonzero(layer == 0), np.flatnonzero(layer == cells[2]),
    )  # fmt: skip
    return _smoothed(net, float(step.max()))


def _grid_values(box: Box, cells: tuple[int, int, int]) -> Floats:
    """The function at the grid: nodes of cells along x and y, half a cell outside along z."""
    step = box.size / np.array(cells)
    axes = [
        np.arange(cells[0]) * step[0],
        np.arange(cells[1]) * step[1],
        (np.arange(cells[2] + 2) - 0.5) * step[2],
    ]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return box.value(points).reshape(cells[0], cells[1], cells[2] + 2)


def _quads(inside: np.ndarray, cells: tuple[int, int, int], axis: int) -> Ints:
    """The cells round each edge along ``axis`` that the surface cuts, (k, 4, 3).

    Cells are numbered along x and y without regard to the period. Edges along z inside the outer
    layers lie between cells whose nodes are on one plane, and have no quad.
    """
    if axis == 2:
        levels = np.arange(1, cells[2])
        ahead = inside[:, :, levels + 1]
    else:
        levels = np.arange(1, cells[2] + 1)
        ahead = np.roll(inside, -1, axis)[:, :, levels]
    here = inside[:, :, levels]
    at = np.argwhere(here != ahead)
    falls = here[tuple(at.T)]
    at[:, 2] = levels[at[:, 2]]
    first, second = (axis + 1) % 3, (axis + 2) % 3
    found = np.repeat(at[:, None], 4, axis=1)
    found[..., first] += AROUND[:, 0] - 1
    found[..., second] += AROUND[:, 1] - 1
    found[falls] = found[falls][:, ::-1]
    return np.asarray(found)


def _unit(vectors: Floats) -> Floats:
    """Vectors (n, 3) of length 1."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1)[:, None])


def _smoothed(net: Net, cell: float) -> Net:
    """The net with its nodes on the surface, evenly; cell: its size in m."""
    one, two, way = _sides(net)
    n = len(net.points)
    outer = np.zeros(n, np.bool_)
    outer[net.bottom] = outer[net.top] = True
    along = ~outer[one] | outer[two]  # neighbours of a node on a plane are on it, too
    one, two, way = one[along], two[along], way[along]
    count = np.bincount(one, minlength=n)[:, None]
    points = _projected(net, net.points, outer, cell)
    for _ in range(ROUNDS):
        ahead = points[two] + way - points[one]
        move = np.stack([np.bincount(one, ahead[:, k], n) for k in range(3)], axis=1) / count
        points = _projected(net, points + STRIDE * move, outer, cell)
    return Net(net.box, points, net.quads, net.shift, net.bottom, net.top)


def _sides(net: Net) -> tuple[Ints, Ints, Floats]:
    """Both ways along each side of a quad: from node, to node, and shift of the latter in m."""
    one, two = net.quads, np.roll(net.quads, -1, axis=1)
    shift = np.roll(net.shift, -1, axis=1) - net.shift
    both = np.concatenate([
        np.concatenate([one.reshape(-1, 1), two.reshape(-1, 1), shift.reshape(-1, 2)], axis=1),
        np.concatenate([two.reshape(-1, 1), one.reshape(-1, 1), -shift.reshape(-1, 2)], axis=1),
    ])  # fmt: skip
    sides = np.unique(both, axis=0)
    way = np.column_stack([sides[:, 2:] * net.box.size[:2], np.zeros(len(sides))])
    return sides[:, 0], sides[:, 1], way


def _projected(net: Net, points: Floats, outer: np.ndarray, cell: float) -> Floats:
    """Points (n, 3) moved to the surface; those on the planes along them."""
    points = points.copy()
    points[net.bottom, 2], points[net.top, 2] = 0.0, net.box.size[2]
    for _ in range(NEWTON):
        slope = net.box.gradient(points)
        slope[outer, 2] = 0.0
        move = -(net.box.value(points) / (slope**2).sum(axis=1))[:, None] * slope
        length = np.linalg.norm(move, axis=1)
        points += move * np.minimum(1.0, LONGEST * cell / np.maximum(length, 1e-300))[:, None]
    return points
