"""A sheet between platens as quads: a block, or a period of a panel with images of its nodes."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from kernels.plates.element import shell
from sweep.array_types import Floats, Ints
from sweep.config.kinds.direction import ALONG
from sweep.config.kinds.sheet import Surface
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.design.surfaces.nets import Net
from sweep.design.surfaces.panel import net_of, net_of_block, printed_thickness
from sweep.scene.plates.shell_mesh import ShellMesh, cut

AROUND = 0.5  # share of a period: how far images of triangles extend around it
WAVES, LAYERS = np.arange(-2, 3), np.arange(1, 5)  # of an imperfection, in a period and upwards
VERTICAL_AXIS = 2  # axis of a net along which it is pressed
VERTICAL = 1e-6  # sine of the angle from the vertical, below which a normal is vertical
SHIFTS = [(0, 0)] + [(i, j) for i in range(-2, 3) for j in range(-2, 3) if (i, j) != (0, 0)]


@dataclass(frozen=True, kw_only=True)
class SheetMesh(ShellMesh):
    """A sheet as quads. Nodes of the period come first. The axes of a node are horizontal, rising,
    and its normal; where the sheet meets a wall, or two walls meet, they are x, y and z. Sizes are
    means of two opposite sides; the shorter diagonal cuts a quad.

    net: of the period, or the block.
    """

    net: Net

    def shells(self, x_rest: Floats, moduli: tuple[float, float]) -> shell.Shell:
        """Quads of any shape."""
        return shell.curved(
            x_rest, self.frames, self.quads, self.size, self.thickness, self.directors, *moduli
        )


@lru_cache(maxsize=16)
def mesh_of_sheet(lattice: Surface) -> SheetMesh:
    """The mesh of a sheet."""
    name, period, quads = lattice.sheet, lattice.period, lattice.quads_per_period
    if lattice.tied_sides:
        net = net_of(name, lattice.turned, period, lattice.pressed_height, quads)
    else:
        net = net_of_block(name, period, lattice.box, lattice.walled, quads)
    return build_sheet(bowed(net, lattice), _thickness(lattice, net))


def bowed(net: Net, lattice: Surface) -> Net:
    """The net with the imperfection of a sheet: nodes moved along their normals by

        a sum g_ijk cos(2 pi (i x / p_x + j y / p_y) + f_ijk) sin(k pi z / H)

    over i, j = -2 .. 2 and k = 1 .. 4, with standard normal numbers g and even phases f from
    `lattice.imperfection_seed`; a is such that the root of the mean square of the bow over height
    and phases is `lattice.imperfection` times the thickness. In a block, whose walls are flat,

        a sum g_ijk sin(i pi x / W) sin(j pi y / D) sin(k pi z / H),   i, j, k = 1 .. 4.
    """
    if lattice.imperfection == 0.0:
        return net
    drawn, share = np.random.default_rng(lattice.imperfection_seed), net.points / net.box.size
    lateral = WAVES if lattice.tied_sides else LAYERS
    waves = np.stack(np.meshgrid(lateral, lateral, LAYERS, indexing="ij"), axis=-1).reshape(-1, 3)
    number = drawn.standard_normal(len(waves))
    if lattice.tied_sides:
        phase = 2.0 * np.pi * drawn.random(len(waves))
        across = np.cos(2.0 * np.pi * share[:, :2] @ waves[:, :2].T + phase)
        mean = 0.5
    else:
        across = np.prod(np.sin(np.pi * share[:, None, :2] * waves[:, :2]), axis=2)
        mean = 0.25
    bow = (across * np.sin(np.pi * share[:, 2:] * waves[:, 2])) @ number
    size = lattice.imperfection * lattice.wall_thickness / np.sqrt(0.5 * mean * (number**2).sum())
    return replace(net, points=net.points + (size * bow)[:, None] * net.normals)


def solid_of(lattice: Surface, mesh: SheetMesh) -> float:
    """Volume of the solid of a sheet, m^3, and of the walls of a block, within which the sheet
    ends.

    The volume of the mesh is scaled from its area to the area of the surface.
    """
    area, sheet = mesh.net.area, mesh.net.wall < 0
    volume = (area * mesh.thickness)[sheet].sum() * lattice.area / area[sheet].sum()
    return float(volume * lattice.inside + lattice.framed)


def _thickness(lattice: Surface, net: Net) -> Floats:
    """Thickness of each quad, (m,) in m."""
    line, along = lattice.wall_thickness, lattice.pressed == ALONG
    if isinstance(lattice, SlicedSheet):
        sheet = printed_thickness(line, lattice.layer_height, net.directions, along)
        return np.where(net.wall < 0, sheet, lattice.outline[0])
    return np.full(len(net.quads), line)


def build_sheet(net: Net, thickness: Floats) -> SheetMesh:
    """The mesh of a net whose quads have this thickness (m,) in m."""
    period, n, repeats = net.box.size[:2], len(net.points), net.box.walls is None
    copies = [np.asarray(shift) for shift in (SHIFTS if repeats else SHIFTS[:1])]
    near = [_near(net, shift) for shift in copies]
    place = np.concatenate([net.shift[near[k]] + shift for k, shift in enumerate(copies)])
    node = np.concatenate([net.quads[rows] for rows in near])
    key = np.concatenate([node[..., None], place], axis=2).reshape(-1, 3)
    first = np.column_stack([np.arange(n), np.zeros((n, 2), np.int64)])
    nodes, corner = _numbered(np.concatenate([first, key]))
    quads = corner[n:].reshape(-1, 4)
    original, shift = np.ascontiguousarray(nodes[:, 0]), nodes[:, 1:]  # as of upright walls
    rest = net.points[original]
    rest[:, :2] += shift * period
    shorter = np.concatenate([_shorter(net.corners)[rows] for rows in near])
    side = np.linalg.norm(np.roll(net.corners, -1, axis=1) - net.corners, axis=2)
    own = quads[: len(net.quads)]
    frames, flat = _frames(net)
    cell = float(np.pi / np.linalg.norm(net.box.phase, axis=0).max())  # half of a period
    directors = np.einsum("mcji,mcj->mci", frames[net.quads], net.corner_normals)
    return SheetMesh(
        height=float(net.box.size[2]),
        rest=rest,
        frames=frames.reshape(-1, 9)[original],
        quads=own,
        size=np.column_stack([side[:, [0, 2]].mean(axis=1), side[:, [1, 3]].mean(axis=1)]),
        thickness=thickness,
        directors=np.where(flat[net.quads][..., None], [0.0, 0.0, 1.0], directors),
        triangles=cut(quads, shorter),
        original=original,
        shift=shift,
        period=period if repeats else np.full(2, np.inf),
        net=net,
        flat=flat[original],
        quad_area=net.area,
        bottom=net.bottom,
        top=net.top,
        capped=VERTICAL_AXIS in (net.box.walls or ()),
        smooth_corners=4 * original[own] + net.wall[:, None] + 1,
        planes=np.full(2, np.inf),
        on=np.zeros((len(original), 2), np.bool_),
        cell=cell,
        force=float(np.min(thickness) ** 3 / (12.0 * cell)),
    )


def _numbered(keys: Ints) -> tuple[Ints, Ints]:
    """Distinct rows of ``keys`` (k, 3) in the order of their first places; their numbers (k,)."""
    rows, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    return rows[order], np.argsort(order)[number.ravel()]


def _near(net: Net, shift: Ints) -> np.ndarray:
    """Which quads are near the period after a ``shift`` (2,) by periods, (m,)."""
    period = net.box.size[:2]
    at = net.corners[..., :2] + shift * period
    inside = np.all((at > -AROUND * period) & (at < (1.0 + AROUND) * period), axis=2)
    return np.asarray(np.any(inside, axis=1))


def _shorter(corners: Floats) -> np.ndarray:
    """Whether the diagonal of a quad from its first corner is the shorter one, (m,)."""
    one, two = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    return np.asarray((one**2).sum(axis=1) < (two**2).sum(axis=1))


def _frames(net: Net) -> tuple[Floats, np.ndarray]:
    """Axes of the nodes as columns of matrices (n, 3, 3): a horizontal tangent, the tangent across
    it, which rises, and the normal; x, y and z at nodes with two tangent planes. Also whether a
    node has a single tangent plane, (n,).
    """
    n = len(net.points)
    planes = np.zeros((n, 4), np.bool_)  # of the surface, and of walls across x, y and z
    planes[net.quads, net.wall[:, None] + 1] = True
    flat, normals = planes.sum(axis=1) == 1, np.empty((n, 3))
    normals[net.quads] = net.corner_normals
    across = np.column_stack([-normals[:, 1], normals[:, 0], np.zeros(n)])
    length = np.linalg.norm(across, axis=1)
    vertical = length < VERTICAL
    across[vertical], length[vertical] = [1.0, 0.0, 0.0], 1.0
    across /= length[:, None]
    own = np.stack([across, np.cross(normals, across), normals], axis=2)
    return np.where(flat[:, None, None], own, np.eye(3)), flat
