"""A net of quads on a level surface in a box: surface nets, then smoothed.

A grid of cells covers the box. Every cell that the surface passes through has one node, every edge
of the grid that the surface cuts one quad between the four cells round it (S. Gibson, Constrained
elastic surface nets, 1998). The nodes then move along the surface towards the means of their
neighbours. All faces are therefore quads, of nearly equal size.

A panel repeats along x and y, and ends at the planes z = 0 and z = height; a block ends at all six
faces of its box. The cells of the outer layers are centred on the faces where a box ends, and their
nodes are moved along the surface to the curves in which it meets these faces.

A face may be a wall. Then a grid of quads covers it, which shares the nodes of the surface where
both meet: edges of the grid that leave the box have quads too, so that three labels have one net.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.design.surfaces.level_set import LevelSet

ROUNDS = 30  # rounds of smoothing
STRIDE = 0.5  # share of the way to the mean of the neighbours, in a round
NEWTON = 4  # steps back to the surface after a move
LONGEST = 0.3  # such a step, in cells
GOOD, GOOD_BESIDE_WALLS = 0.3, 0.15  # `Net.quality`; quads beside a curve are half as wide
MORE = sorted(product(range(3), repeat=3), key=sum)  # cells
PLACES = tuple(product((0.13, 0.63), repeat=2))  # places of the box that are tried, in cells
AROUND = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])  # cells round an edge, from the last of these


@dataclass(frozen=True)
class Box:
    """A part of a level surface, in its own axes.

    size (3,): along x, y and z, m. phase (3, 3): phases by coordinates in 1/m; its columns are
    orthogonal. origin (3,): phases at the corner of the box. walls: axes across which its faces are
    walls; None for a panel, whose x and y are whole periods.
    """

    surface: LevelSet
    size: Floats
    phase: Floats
    origin: Floats
    walls: tuple[int, ...] | None = None

    @property
    def ends(self) -> np.ndarray:
        """Along which axes it ends, (3,)."""
        return np.array([self.walls is not None, self.walls is not None, True])

    def value(self, points: Floats) -> Floats:
        """The function at points (n, 3) in m."""
        return self.surface.value(points @ self.phase.T + self.origin)

    def gradient(self, points: Floats) -> Floats:
        """Its gradient (n, 3) in 1/m."""
        return self.surface.gradient(points @ self.phase.T + self.origin) @ self.phase


@dataclass(frozen=True)
class Net:
    """A net of quads on the surface of a ``box`` and on its walls; n nodes.

    points (n, 3): m. quads (m, 4): nodes in order round each quad, its normal to the side of the
    gradient, or out of the box. shift (m, 4, 2): by how many periods the corner of a quad is moved
    along x and y from the node. wall (m,): axis across which it is a wall, -1 on the surface. face
    (n, 3): on which faces a node is, -1, 0 between them, or 1.
    """

    box: Box
    points: Floats
    quads: Ints
    shift: Ints
    wall: Ints
    face: Ints

    @property
    def bottom(self) -> Ints:
        """Nodes on the plane z = 0."""
        return np.flatnonzero(self.face[:, 2] < 0)

    @property
    def top(self) -> Ints:
        """Nodes on the plane z = height."""
        return np.flatnonzero(self.face[:, 2] > 0)

    @cached_property
    def on_surface(self) -> np.ndarray:
        """Which nodes are on the surface, (n,)."""
        on = np.zeros(len(self.points), np.bool_)
        on[self.quads[self.wall < 0]] = True
        return on

    @cached_property
    def normals(self) -> Floats:
        """Unit normals of the surface at its nodes, (n, 3); zero at other ones."""
        normals, on = np.zeros_like(self.points), self.on_surface
        normals[on] = _unit(self.box.gradient(self.points[on]))
        return normals

    @cached_property
    def corners(self) -> Floats:
        """Positions of the corners of the quads, (m, 4, 3) in m."""
        at = self.points[self.quads]
        at[..., :2] += self.shift * self.box.size[:2]
        return at

    @cached_property
    def corner_normals(self) -> Floats:
        """Unit normals of the surface or the wall at the corners of the quads, (m, 4, 3)."""
        across = np.eye(3)[self.wall][:, None] * self.face[self.quads]
        return np.where(self.wall[:, None, None] < 0, self.normals[self.quads], across)

    @cached_property
    def quality(self) -> float:
        """The least, over all corners, of the area of its two sides over the squared mean side: 1
        in a net of squares, negative if a quad is not convex.
        """
        ahead = np.roll(self.corners, -1, axis=1) - self.corners
        areas = np.cross(np.roll(ahead, 1, axis=1), ahead)
        size = np.linalg.norm(areas, axis=2)
        size[np.einsum("mci,mi->mc", areas, self.directions) < 0.0] *= -1.0
        return float(size.min() / np.mean(np.linalg.norm(ahead, axis=2)) ** 2)

    @cached_property
    def directions(self) -> Floats:
        """Unit normals of the quads in their middles, (m, 3)."""
        at = self.corners
        return _unit(np.cross(at[:, 2] - at[:, 0], at[:, 3] - at[:, 1]))

    @cached_property
    def area(self) -> Floats:
        """Area of each quad, from the triangles between its sides and its centre, (m,) m^2."""
        centre = self.corners.mean(axis=1, keepdims=True)
        arms = self.corners - centre
        parts = np.cross(arms, np.roll(arms, -1, axis=1))
        return np.asarray(0.5 * np.linalg.norm(parts, axis=2).sum(axis=1))


def best_net(box: Box, period: float, quads: int) -> Net:
    """The first net of good quads, else the best one; about ``quads`` in a ``period`` (m).

    The position of the grid on the surface decides which quads meet at a node, and so how slender
    some of them are. The box of a panel may move along x and y without any other change; up to two
    more cells along each axis are tried, too.
    """
    best, good = None, GOOD if box.walls is None else GOOD_BESIDE_WALLS
    x, y, z = (max(round(quads * side / period), 2) for side in box.size)
    for more in MORE:
        grid = (x + more[0], y + more[1], z + more[2])
        for place in PLACES if box.walls is None else ((0.0, 0.0),):
            start = box.phase[:, :2] @ (np.array(place) * box.size[:2] / np.array(grid[:2]))
            net = build_net(replace(box, origin=box.origin + start), grid)
            if net.quality > good:
                return net
            if best is None or net.quality > best.quality:
                best = net
    assert best is not None
    return best


def build_net(box: Box, cells: tuple[int, int, int]) -> Net:
    """A net of ``box`` on a grid of so many cells along x, y and z."""
    count, step = np.array(cells), box.size / np.array(cells)
    inside = _grid_values(box, cells) > 0.0
    cell = np.concatenate([_quads(inside, box.ends, axis) for axis in range(3)])
    side, wall = np.zeros(len(cell), np.int64), np.full(len(cell), -1)
    for axis in box.walls or ():
        covered, of = _on_walls(inside, axis)
        cell, side = np.concatenate([cell, covered]), np.append(side, of)
        wall = np.append(wall, np.full(len(of), axis))
    places = np.where(box.ends, count + 1, count)  # of cells along each axis
    number = np.ravel_multi_index(np.moveaxis((cell % places)[..., ::-1], 2, 0), places[::-1])
    used, corner = np.unique(number, return_inverse=True)
    at = np.stack(np.unravel_index(used, places[::-1])[::-1], axis=1)
    face = box.ends * ((at == count).astype(np.int64) - (at == 0))
    points = np.where(face > 0, box.size, np.where(box.ends, at, at + 0.5) * step)
    net = Net(box, points, corner.reshape(-1, 4), (cell // places)[..., :2], wall, face)
    return _smoothed(_padded(net, side) if box.walls else net, float(step.max()))


def _padded(net: Net, side: Ints) -> Net:
    """The net with a row of quads on both sides of each curve in which the surface meets a wall.

    Without these, a quad with three corners on such a curve would become a triangle. side (m,): on
    which side of the surface a quad of a wall is, -1 or 1; 0 for quads of the surface.
    """
    n, first = len(net.points), int((side == 0).sum())
    old, side, wall = net.quads[first:], side[first:], net.wall[first:]
    quads, moved = old.copy(), net.on_surface[old]  # corners, which leave the curve
    copies, new = np.unique((old + n * (side > 0)[:, None])[moved], return_inverse=True)
    quads[moved] = n + new
    ends = np.sort(np.stack([old, np.roll(old, -1, axis=1)], axis=-1).reshape(-1, 2))
    _, number = np.unique(ends, axis=0, return_inverse=True)
    between = np.bincount(number.ravel(), np.repeat(side, 4))[number.ravel()] == 0.0
    at, k = np.nonzero(between.reshape(-1, 4))  # sides of quads that are parts of the curve
    ahead = (k + 1) % 4
    rows = np.column_stack([old[at, k], old[at, ahead], quads[at, ahead], quads[at, k]])
    return replace(
        net,
        points=np.concatenate([net.points, net.points[copies % n]]),
        face=np.concatenate([net.face, net.face[copies % n]]),
        quads=np.concatenate([net.quads[:first], quads, rows]),
        wall=np.concatenate([net.wall, wall[at]]),
        shift=np.concatenate([net.shift, np.zeros((len(at), 4, 2), np.int64)]),
    )


def _grid_values(box: Box, cells: tuple[int, int, int]) -> Floats:
    """The function at the grid: between the nodes of cells, on the side of lower coordinates where
    the box repeats.
    """
    step = box.size / np.array(cells)
    axes = [(np.arange(n) + 0.5 * e) * h for n, e, h in zip(cells, box.ends, step, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return box.value(points).reshape(cells)


def _quads(inside: np.ndarray, ends: np.ndarray, axis: int) -> Ints:
    """The cells round each edge along ``axis`` that the surface cuts, (k, 4, 3).

    Cells are numbered along x and y of a panel without regard to the period.
    """
    ahead = np.roll(inside, -1, axis)
    if ends[axis]:
        last = np.arange(inside.shape[axis] - 1)
        inside, ahead = np.take(inside, last, axis), np.take(ahead, last, axis)
    at = np.argwhere(inside != ahead)
    falls = inside[tuple(at.T)]
    edges = np.repeat(at[:, None] + ends, 4, axis=1)
    for k in (1, 2):
        edges[..., (axis + k) % 3] += AROUND[:, k - 1] - 1
    edges[falls] = edges[falls][:, ::-1]
    return np.asarray(edges)


def _on_walls(inside: np.ndarray, axis: int) -> tuple[Ints, Ints]:
    """The cells at the corners of the quads of both walls across ``axis``, (k, 4, 3), and the side
    of the surface on which each quad is, (k,): 1 inside, else -1.
    """
    one, two = (axis + 1) % 3, (axis + 2) % 3
    first = np.indices([inside.shape[one], inside.shape[two]]).reshape(2, -1).T
    low = np.zeros((len(first), 4, 3), np.int64)
    low[..., [one, two]] = first[:, None] + AROUND
    high = low.copy()
    high[..., axis] = inside.shape[axis]
    layers = np.moveaxis(inside, (axis, one, two), (0, 1, 2))[[0, -1]]
    return np.concatenate([low[:, ::-1], high]), np.where(layers, 1, -1).ravel()


def _unit(vectors: Floats) -> Floats:
    """Vectors (n, 3) of length 1."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1)[:, None])


def _smoothed(net: Net, cell: float) -> Net:
    """The net with its nodes spread evenly on the surface and the walls; cell: its size in m."""
    one, two, way = _sides(net)
    n = len(net.points)
    outer = np.column_stack([net.face != 0, net.on_surface])
    along = np.all(~outer[one] | outer[two], axis=1)  # neighbours of a node on a face are on it
    one, two, way = one[along], two[along], way[along]
    count = np.maximum(np.bincount(one, minlength=n), 1)[:, None]
    points = _projected(net, net.points, cell)
    for _ in range(ROUNDS):
        ahead = points[two] + way - points[one]
        move = np.stack([np.bincount(one, ahead[:, k], n) for k in range(3)], axis=1) / count
        points = _projected(net, points + STRIDE * move, cell)
    return replace(net, points=points)


def _sides(net: Net) -> tuple[Ints, Ints, Floats]:
    """Both directions along each side of a quad: from node, to node, and shift of the latter in
    m.
    """
    one, two = net.quads, np.roll(net.quads, -1, axis=1)
    shift = np.roll(net.shift, -1, axis=1) - net.shift
    both = np.concatenate([
        np.concatenate([one.reshape(-1, 1), two.reshape(-1, 1), shift.reshape(-1, 2)], axis=1),
        np.concatenate([two.reshape(-1, 1), one.reshape(-1, 1), -shift.reshape(-1, 2)], axis=1),
    ])  # fmt: skip
    sides = np.unique(both, axis=0)
    way = np.column_stack([sides[:, 2:] * net.box.size[:2], np.zeros(len(sides))])
    return sides[:, 0], sides[:, 1], way


def _projected(net: Net, points: Floats, cell: float) -> Floats:
    """Points (n, 3) moved to the surface, along the faces on which they are."""
    points = points.copy()
    of = np.flatnonzero(net.on_surface)
    for _ in range(NEWTON):
        slope = np.where(net.face[of] != 0, 0.0, net.box.gradient(points[of]))
        move = -(net.box.value(points[of]) / (slope**2).sum(axis=1))[:, None] * slope
        length = np.linalg.norm(move, axis=1)
        points[of] += move * np.minimum(1.0, LONGEST * cell / np.maximum(length, 1e-300))[:, None]
    return points
