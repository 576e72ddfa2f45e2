"""From a plan of walls to a grid of quads: nodes, directors, areas, triangles for contact."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from kernels.plates.element import shell
from sweep.array_types import Floats, Ints
from sweep.config.kinds.lattice import Lattice
from sweep.design.period import Endless
from sweep.design.upright_plan import Plan, plan_of, quads_along
from sweep.scene.plates.imperfection import amplitudes, bow
from sweep.scene.plates.shell_mesh import ShellMesh, cut

STRAIGHT = 1e-9  # sine of the angle below which two walls are in one plane
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, kw_only=True)
class PlateMesh(ShellMesh):
    """Upright walls, divided into quads: c columns of nodes one above another.

    The columns are the points of the plan, then the columns inside walls; the nodes of a column are
    numbered upwards, so that node = column x (layers + 1) + level. The axes of a wall are e_s along
    it, e_z up, and its normal n = e_s x e_z to the right; the axes of a node are (e_s, e_z, n)
    where all of its quads are in one plane, else x, y and z. Nodes are bowed by the imperfection,
    whereas sizes belong to flat quads, and triangles have alternate diagonals.

    wall (m,): in the plan. level (n,): of a node.
    """

    plan: Plan
    wall: Ints
    level: Ints

    @property
    def layers(self) -> int:
        """Number of quads up the height."""
        return int(self.level.max())

    def shells(self, x_rest: Floats, moduli: tuple[float, float]) -> shell.Shell:
        """Flat rectangles, without stress in the bowed shape at rest."""
        walls = shell.rectangles(self.quads, self.size, self.thickness, self.directors, *moduli)
        shell.measure_rest(x_rest, self.frames, walls, shell.make_scratch())
        return walls


@lru_cache(maxsize=16)
def build_mesh(lattice: Lattice) -> PlateMesh:
    """The mesh of a lattice that is pressed along its cells, with the resolution and layers of its
    config.
    """
    assert lattice.layers is not None
    network = lattice.network
    plan = plan_of(network, lattice.symmetry == "quarter")
    along, bows = quads_along(plan, lattice.wall_quads), amplitudes(plan, lattice)
    endless = network if isinstance(network, Endless) else None
    if endless is not None:
        bows = bows[endless.original]
    return extruded(plan, along, lattice.layers, lattice.depth, bows, endless)


def extruded(
    plan: Plan,
    along: Ints,
    layers: int,
    height: float,
    amplitude: Floats | None = None,
    endless: Endless | None = None,
) -> PlateMesh:
    """A plan, extruded to a height (m) in ``layers`` and ``along`` (w,) equal quads of each wall.

    amplitude (w, j): of the bow of each wall, m (`imperfection.amplitudes`); None: flat walls.
    endless: the repeating plan; its walls are the walls of the period, then copies.
    """
    walls, points = len(plan.walls), len(plan.points)
    of_wall = np.repeat(np.arange(walls), along)  # of each strip between two columns
    number = np.arange(len(of_wall)) - np.repeat(np.cumsum(along) - along, along)
    columns = _columns(plan, along, of_wall, number)
    length = plan.length
    axis = np.diff(plan.points[plan.walls], axis=1)[:, 0] / length[:, None]
    inner = columns[number > 0, 0]
    wall_of = np.concatenate([np.full(points, -1), of_wall[number > 0]])
    share = np.concatenate([np.zeros(points), (number / along[of_wall])[number > 0]])
    plane = np.concatenate([plan.points, np.empty((len(inner), 2))])
    start = plan.points[plan.walls[wall_of[inner], 0]]
    plane[inner] = start + (share * length[wall_of])[inner, None] * axis[wall_of[inner]]
    level = np.arange(layers + 1)
    rest = np.empty((len(plane), layers + 1, 3))
    rest[..., :2], rest[..., 2] = plane[:, None], height * level / layers
    right = np.column_stack([axis[:, 1], -axis[:, 0], np.zeros(walls)])
    if amplitude is not None:
        _bow_walls(rest, plan, wall_of[inner], share[inner], amplitude, right)
    frames, flat = _frames(plan, axis, wall_of)
    origin, shift = np.arange(len(plane)), np.zeros((len(plane), 2), np.int64)
    if endless is not None:
        origin, shift = endless.copied(along - 1)
    frames, flat = frames[origin], flat[origin]
    strip = columns[:, [0, 1, 1, 0]][:, None] * (layers + 1)
    quads = strip + np.array([0, 0, 1, 1]) + np.arange(layers)[:, None]
    directors = np.einsum("scji,sj->sci", frames[columns[:, [0, 1, 1, 0]]], right[of_wall])
    size = np.column_stack([length / along, np.full(walls, height / layers)])
    on = np.concatenate([plan.on, np.zeros((len(inner), 2), np.bool_)])
    wall, quads = np.repeat(of_wall, layers), quads.reshape(-1, 4)
    level = np.tile(level, len(plane))
    own = slice(None if endless is None else int(np.searchsorted(wall, endless.own)))
    original = (origin[:, None] * (layers + 1) + np.arange(layers + 1)).ravel()
    of_node_and_wall = original[quads[own]] * walls + wall[own][:, None]
    _, smooth = np.unique(of_node_and_wall, return_inverse=True)
    return PlateMesh(
        plan=plan,
        height=height,
        rest=rest.reshape(-1, 3),
        frames=np.repeat(frames.reshape(-1, 9), layers + 1, axis=0),
        quads=quads[own],
        size=size[wall][own],
        quad_area=size[wall][own].prod(axis=1),
        thickness=plan.thickness[wall][own],
        wall=wall[own],
        directors=np.repeat(directors, layers, axis=0)[own],
        flat=np.repeat(flat, layers + 1),
        level=level,
        bottom=np.flatnonzero(level == 0),
        top=np.flatnonzero(level == layers),
        smooth_corners=smooth.reshape(-1, 4),
        planes=plan.planes,
        on=np.repeat(on, layers + 1, axis=0),
        cell=float(plan.span.mean()),
        force=float(np.min(plan.thickness**3 / (12.0 * plan.span))),
        triangles=cut(quads, (np.repeat(number, layers) + level[quads[:, 0]]) % 2 == 0),
        original=original,
        shift=np.repeat(shift, layers + 1, axis=0),
        period=np.full(2, np.inf) if endless is None else endless.period,
    )


def _bow_walls(
    rest: Floats, plan: Plan, wall_of: Ints, share: Floats, amplitude: Floats, right: Floats
) -> None:
    """Bow the columns of ``rest`` (c, layers + 1, 3) inside walls, also on mirror planes.

    wall_of, share (i,): wall of each column inside a wall, and the share of the wall before it.
    amplitude (w, j): as in `extruded`. right (w, 3): normal of each wall.
    """
    inner = len(plan.points) + np.arange(len(share))
    levels = rest.shape[1]
    cut = np.flatnonzero(plan.on[plan.walls[:, 1]].any(axis=1))
    bowed, of = np.append(inner, plan.walls[cut, 1]), np.append(wall_of, cut)
    across = np.append(share, np.ones(len(cut))) * (plan.length / plan.span)[of]
    up = np.arange(levels) / (levels - 1)
    shift = bow(
        np.repeat(amplitude[of], levels, axis=0), np.repeat(across, levels), np.tile(up, len(of))
    )
    rest[bowed] += shift.reshape(len(of), levels, 1) * right[of, None]


def _columns(plan: Plan, along: Ints, of_wall: Ints, number: Ints) -> Ints:
    """The columns of nodes at the start and the end of each strip of quads, (strips, 2)."""
    inner = len(plan.points) + np.cumsum(number > 0) - 1
    columns = np.column_stack([inner, inner + 1])
    first, last = number == 0, number == along[of_wall] - 1
    columns[first, 0] = plan.walls[of_wall[first], 0]
    columns[last, 1] = plan.walls[of_wall[last], 1]
    return columns


def _frames(plan: Plan, axis: Floats, wall_of: Ints) -> tuple[Floats, np.ndarray]:
    """Axes of the nodes of each column as columns of a matrix (c, 3, 3), and whether it is flat.

    axis (w, 2): direction of each wall. wall_of (c,): the wall of a column inside it, else -1.
    """
    inside = wall_of >= 0
    first = wall_of.copy()
    flat = inside.copy()
    for column in np.flatnonzero(~inside):
        directions = axis[(plan.walls == column).any(axis=1)]
        first[column] = np.flatnonzero((plan.walls == column).any(axis=1))[0]
        sine = directions[:, 0] * directions[0, 1] - directions[:, 1] * directions[0, 0]
        flat[column] = np.abs(sine).max() <= STRAIGHT
    along = np.column_stack([axis[first], np.zeros(len(first))])
    up = np.broadcast_to(UP, along.shape)
    own = np.stack([along, up, np.cross(along, up)], axis=2)
    return np.where(flat[:, None, None], own, np.eye(3)), flat
