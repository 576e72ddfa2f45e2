"""One period of a sheet between platens: its net of quads, and images of its nodes around it.

Quads at the sides of the period reach nodes of the next one: images, which move as their originals.
Further images carry copies of triangles that the period may touch. An image has no mass and no
area, so that each pair of surfaces counts once.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from sweep.config.kinds.direction import ALONG
from sweep.config.kinds.sheet import Surface
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.design.surfaces.nets import Net
from sweep.design.surfaces.panel import net_of
from sweep.scene.mesh import Floats, Ints
from sweep.scene.plates import repeats

AROUND = 0.5  # of a period: how far images of triangles stand around it
WAVES, LAYERS = np.arange(-2, 3), np.arange(1, 5)  # of an imperfection, in a period and upwards
VERTICAL = 1e-6  # sine of the angle from the vertical, below which a normal is vertical
SHIFTS = [(0, 0)] + [(i, j) for i in range(-2, 3) for j in range(-2, 3) if (i, j) != (0, 0)]


@dataclass(frozen=True)
class SheetMesh:
    """A sheet as quads: n nodes, those of the period first, then images; m quads; k triangles.

    net: of the period. rest (n, 3): nodes at rest, m. frames (n, 9): axes of each node at rest as
    columns of a matrix, row by row: horizontal, rising, normal. original (n,): the node of which a
    node is an image, or itself; shift (n, 2): by how many periods along x and y it is moved. quads
    (m, 4) with their thickness (m,) in m. triangles (k, 3): of the quads, then of their images.
    """

    net: Net
    rest: Floats
    frames: Floats
    original: Ints
    shift: Ints
    quads: Ints
    thickness: Floats
    triangles: Ints

    @property
    def n_nodes(self) -> int:
        """Number of nodes, images too."""
        return len(self.rest)

    @property
    def height(self) -> float:
        """Distance of the platens at rest, m."""
        return float(self.net.box.size[2])

    @property
    def bottom(self) -> Ints:
        """Nodes at the lower platen."""
        return self.net.bottom

    @property
    def top(self) -> Ints:
        """Nodes at the upper platen."""
        return self.net.top

    @cached_property
    def own(self) -> Ints:
        """Nodes of the period."""
        return repeats.own(self)

    @property
    def smooth_corners(self) -> Ints:
        """The number of the original of each corner of the quads, (m, 4)."""
        return np.asarray(self.original[self.quads])

    @property
    def period(self) -> Floats:
        """Periods along x and y, m."""
        return self.net.box.size[:2]

    @property
    def flat(self) -> np.ndarray:
        """Whether all quads of a node share its tangent plane, (n,): everywhere on a sheet."""
        return np.ones(self.n_nodes, np.bool_)

    @property
    def on(self) -> np.ndarray:
        """Whether a node is on a mirror plane, (n, 2): nowhere."""
        return np.zeros((self.n_nodes, 2), np.bool_)

    @property
    def copies(self) -> int:
        """Equal parts of the whole, of which this is one."""
        return 1

    @property
    def directors(self) -> Floats:
        """Normals at the corners in the axes of their nodes, (m, 4, 3)."""
        return np.tile([0.0, 0.0, 1.0], (len(self.quads), 4, 1))

    @cached_property
    def size(self) -> Floats:
        """Mean lengths of the two pairs of opposite sides of each quad, (m, 2) in m."""
        side = np.linalg.norm(np.roll(self.net.corners, -1, axis=1) - self.net.corners, axis=2)
        return np.column_stack([side[:, [0, 2]].mean(axis=1), side[:, [1, 3]].mean(axis=1)])

    @property
    def cell(self) -> float:
        """Typical width of a wall between two others, m: half of the shorter period."""
        return float(0.5 * self.net.box.size[:2].min())

    @property
    def force(self) -> float:
        """Typical force over modulus, m^2: t^3 / (12 l) of a wall of width l."""
        return float(np.min(self.thickness) ** 3 / (12.0 * self.cell))

    @cached_property
    def area(self) -> Floats:
        """A quarter of the area of each quad at a node, (n,) m^2."""
        return repeats.quarters(self, self.net.area)

    @cached_property
    def volume(self) -> Floats:
        """A quarter of the volume of each quad at a node, (n,) m^3."""
        return repeats.quarters(self, self.net.area * self.thickness)

    @cached_property
    def node_thickness(self) -> Floats:
        """Mean thickness at a node, (n,) m."""
        own = self.own
        return np.asarray((self.volume[own] / self.area[own])[self.original])


@lru_cache(maxsize=16)
def mesh_of_sheet(lattice: Surface) -> SheetMesh:
    """The mesh of a sheet."""
    net = net_of(
        lattice.sheet,
        lattice.pressed,
        lattice.period,
        lattice.pressed_height,
        lattice.quads_per_period,
    )
    return build_sheet(bowed(net, lattice), _thickness(lattice, net))


def bowed(net: Net, lattice: Surface) -> Net:
    """The net with the imperfection of a sheet: nodes moved along their normals by

        a sum g_ijk cos(2 pi (i x / p_x + j y / p_y) + f_ijk) sin(k pi z / H)

    over i, j = -2 .. 2 and k = 1 .. 4, with standard normal numbers g and even phases f from
    `lattice.imperfection_seed`; a is such that the root of the mean square of the bow over height
    and phases is `lattice.imperfection` times the thickness.
    """
    if lattice.imperfection == 0.0:
        return net
    drawn = np.random.default_rng(lattice.imperfection_seed)
    waves = np.stack(np.meshgrid(WAVES, WAVES, LAYERS, indexing="ij"), axis=-1).reshape(-1, 3)
    number, phase = drawn.standard_normal(len(waves)), 2.0 * np.pi * drawn.random(len(waves))
    share = net.points / net.box.size
    across = np.cos(2.0 * np.pi * share[:, :2] @ waves[:, :2].T + phase)
    bow = (across * np.sin(np.pi * share[:, 2:] * waves[:, 2])) @ number
    size = lattice.imperfection * lattice.wall_thickness / np.sqrt(0.25 * (number**2).sum())
    return replace(net, points=net.points + (size * bow)[:, None] * net.normals)


def solid_of(lattice: Surface, mesh: SheetMesh) -> float:
    """Volume of a sheet, m^3: that of its mesh, less what that has more area than the surface."""
    return float(mesh.volume.sum() * lattice.area / mesh.net.area.sum())


def _thickness(lattice: Surface, net: Net) -> Floats:
    """Thickness of each quad, (m,) in m."""
    walls = np.full(len(net.quads), lattice.wall_thickness)
    if not isinstance(lattice, SlicedSheet):
        return walls
    layers = 2 if lattice.pressed == ALONG else 1  # axis of the net across the layers
    steep = np.sqrt(1.0 - net.directions[:, layers] ** 2)
    return np.maximum(walls * steep, lattice.layer_height)


def build_sheet(net: Net, thickness: Floats) -> SheetMesh:
    """The mesh of a net whose quads have this thickness (m,) in m."""
    period, n = net.box.size[:2], len(net.points)
    copies = [np.asarray(shift) for shift in SHIFTS]
    near = [
        _near(net, shift) if np.any(shift != 0) else np.ones(len(net.quads), bool)
        for shift in copies
    ]
    place = np.concatenate([net.shift[near[k]] + shift for k, shift in enumerate(copies)])
    node = np.concatenate([net.quads[rows] for rows in near])
    key = np.concatenate([node[..., None], place], axis=2).reshape(-1, 3)
    own = np.column_stack([np.arange(n), np.zeros((n, 2), np.int64)])
    nodes, corner = _numbered(np.concatenate([own, key]))
    quads = corner[n:].reshape(-1, 4)
    original, shift = nodes[:, 0], nodes[:, 1:]
    rest = net.points[original]
    rest[:, :2] += shift * period
    cut = np.concatenate([_shorter(net.corners)[rows] for rows in near])
    frames = _frames(net.normals)
    return SheetMesh(
        net, rest, frames[original], original, shift, quads[: len(net.quads)], thickness,
        _triangles(quads, cut),
    )  # fmt: skip


def _numbered(keys: Ints) -> tuple[Ints, Ints]:
    """Distinct rows of ``keys`` (k, 3) in the order of their first places; their numbers (k,)."""
    rows, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    return rows[order], rank[number.ravel()]


def _near(net: Net, shift: Ints) -> np.ndarray:
    """Which quads are near the period if they are moved by ``shift`` (2,) periods, (m,)."""
    period = net.box.size[:2]
    at = net.corners[..., :2] + shift * period
    inside = np.all((at > -AROUND * period) & (at < (1.0 + AROUND) * period), axis=2)
    return np.asarray(np.any(inside, axis=1))


def _shorter(corners: Floats) -> np.ndarray:
    """Whether the diagonal of a quad from its first corner is the shorter one, (m,)."""
    one, two = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    return np.asarray((one**2).sum(axis=1) < (two**2).sum(axis=1))


def _triangles(quads: Ints, first: np.ndarray) -> Ints:
    """Two triangles of each quad, cut along the diagonal from its first corner or the other."""
    a, b, c, d = quads.T
    one = np.where(first[:, None], np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    two = np.where(first[:, None], np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    return np.stack([one, two], axis=1).reshape(-1, 3)


def _frames(normals: Floats) -> Floats:
    """Axes (n, 9): a horizontal tangent, the tangent across it, which rises, and the normal."""
    across = np.column_stack([-normals[:, 1], normals[:, 0], np.zeros(len(normals))])
    length = np.linalg.norm(across, axis=1)
    vertical = length < VERTICAL
    across[vertical], length[vertical] = [1.0, 0.0, 0.0], 1.0
    across /= length[:, None]
    return np.stack([across, np.cross(normals, across), normals], axis=2).reshape(-1, 9)
