"""Shells for tests of plates: flat grids, walls that meet along a line, and their derivatives."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from kernels.laws.law import Memory
from kernels.laws.relaxing_sheet import RelaxingSheet
from kernels.laws.sheet import neo_hookean
from kernels.plates.element import relaxing_shear, shell
from kernels.plates.element.shell import Shell
from sweep.array_types import Floats
from tests.support.kernels.sheets import elastic_only
from tests.support.kernels.terms import Term
from tests.support.materials import memory

MODULUS = 12.0
LINEAR = elastic_only(neo_hookean(MODULUS))
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Structure:
    """Shells at rest. points (n, 3). frames (n, 9). unit (6 n + 2,): size of every coordinate."""

    points: Floats
    frames: Floats
    walls: Shell

    @property
    def rest(self) -> Floats:
        """Coordinates (6 n + 2,) at rest; the last two are the heights of the platens."""
        x = np.zeros((len(self.points), 6))
        x[:, :3] = self.points
        return np.append(x.ravel(), [0.0, self.points[:, 2].max()])

    @property
    def unit(self) -> Floats:
        """Side of a quad for positions, 1 for rotations."""
        unit = np.ones((len(self.points), 6))
        unit[:, :3] = self.walls.size.mean()
        return np.append(unit.ravel(), [1.0, 1.0])


def structure(
    plan: list[tuple[float, float]],
    walls: list[tuple[int, int]],
    pieces: int,
    height: float,
    layers: int,
    thickness: float = 0.1,
    modulus: float = MODULUS,
) -> Structure:
    """Walls (pairs of joints of a ``plan``) of ``height`` with ``pieces`` x ``layers`` quads each.

    Joints of several walls have the frame I, other nodes the frame of their wall, (e_s, e_z, n).
    """
    joints = np.array(plan, float)
    columns = [*joints]
    along: list[tuple[int, int, Floats, float]] = []
    frames = [np.eye(3)] * len(joints)
    for i, k in walls:
        step = (joints[k] - joints[i]) / pieces
        length = float(np.hypot(*step))
        s = np.append(step / length, 0.0)
        inner = range(len(columns), len(columns) + pieces - 1)
        own = np.column_stack([s, UP, np.cross(s, UP)])
        for end in (i, k):
            if sum(end in wall for wall in walls) == 1:
                frames[end] = own
        columns += [joints[i] + step * (m + 1) for m in range(pieces - 1)]
        frames += [own] * (pieces - 1)
        path = [i, *inner, k]
        along += [(a, b, s, length) for a, b in pairwise(path)]
    n, levels = len(columns), np.linspace(0.0, height, layers + 1)
    points = np.array([[*c, z] for z in levels for c in columns])
    quads, size, directors = [], [], []
    for level in range(layers):
        for a, b, s, length in along:
            quads.append([level * n + a, level * n + b, (level + 1) * n + b, (level + 1) * n + a])
            size.append([length, height / layers])
            normal = np.cross(s, UP)
            directors.append([frames[c].T @ normal for c in (a, b, b, a)])
    shells = shell.rectangles(
        np.array(quads), np.array(size), np.full(len(quads), thickness), np.array(directors),
        5.0 / 6.0 * modulus / 3.0, 5.0 / 18.0 * modulus,
    )  # fmt: skip
    return Structure(points, np.tile([f.ravel() for f in frames], (layers + 1, 1)), shells)


def surface(
    grid: tuple[int, int],
    place: Callable[[Floats, Floats], Floats],
    normal: Callable[[Floats, Floats], Floats],
    thickness: float = 0.1,
    modulus: float = MODULUS,
    poisson: float = 0.5,
    shake: float = 0.0,
) -> Structure:
    """A grid of quads over u, v of 0 to 1 on a surface, with a frame (t1, t2, n) at each node.

    place, normal: (n, 3) at u, v (n,). shake: random moves of the inner nodes over the surface, in
    units of the grid.
    """
    u, v = (
        each.ravel()
        for each in np.meshgrid(*(np.linspace(0.0, 1.0, k + 1) for k in grid), indexing="ij")
    )
    inner = (u > 0) & (u < 1) & (v > 0) & (v < 1)
    move = shake * inner * np.random.default_rng(0).uniform(-1, 1, (2, u.size))
    u, v = u + move[0] / grid[0], v + move[1] / grid[1]
    points, normals = place(u, v), normal(u, v)
    number = np.arange(u.size).reshape(grid[0] + 1, grid[1] + 1)
    quads = np.stack(
        [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=2
    ).reshape(-1, 4)
    return smooth(points, normals, quads, thickness, modulus, poisson)


def smooth(
    points: Floats,
    normals: Floats,
    quads: Any,
    thickness: float = 0.1,
    modulus: float = MODULUS,
    poisson: float = 0.5,
) -> Structure:
    """Quads of a smooth surface with ``normals`` (n, 3) to the same side as the normals of the
    quads.
    """
    aside = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    one = np.cross(aside, normals)
    one /= np.linalg.norm(one, axis=1)[:, None]
    frames = np.stack([one, np.cross(normals, one), normals], axis=2).reshape(-1, 9)
    directors = np.tile([0.0, 0.0, 1.0], (len(quads), 4, 1))
    x = np.zeros((len(points), 6))
    x[:, :3] = points
    shear_modulus = 5.0 / 12.0 * modulus / (1.0 + poisson)
    side = np.linalg.norm(points[quads] - points[np.roll(quads, -1, axis=1)], axis=2)
    size = np.column_stack([side[:, [0, 2]].mean(axis=1), side[:, [1, 3]].mean(axis=1)])
    shells = shell.curved(
        np.append(x.ravel(), [0.0, 0.0]), frames, quads, size, np.full(len(quads), thickness),
        directors, shear_modulus, shear_modulus,
    )  # fmt: skip
    return Structure(points, frames, shells)


def plate(
    nx: int = 2, nz: int = 2, width: float = 1.0, height: float = 1.0, thickness: float = 0.1
) -> Structure:
    """A wall along x, whose frames are all (e_s, e_z, n)."""
    return structure([(0.0, 0.0), (width, 0.0)], [(0, 1)], nx, height, nz, thickness)


def cross(thickness: float = 0.1) -> Structure:
    """Three walls at a joint line, of one column of quads each."""
    plan = [(0.0, 0.0), (1.0, 0.1), (-0.4, 0.8), (-0.5, -0.7)]
    return structure(plan, [(0, 1), (0, 2), (0, 3)], 1, 0.8, 1, thickness)


def shaken(of: Structure, seed: int, size: float, turn: float) -> Floats:
    """Rest coordinates with random changes, of positions in units of the quads."""
    r = np.random.default_rng(seed)
    x = of.rest
    move = np.zeros((len(of.points), 6))
    move[:, :3] = size * of.walls.size.mean() * r.uniform(-1, 1, of.points.shape)
    move[:, 3:] = turn * r.uniform(-1, 1, of.points.shape)
    x[:-2] += move.ravel()
    return x


def virgin(of: Structure, law: RelaxingSheet) -> Memory:
    """Memory of all material points before any step."""
    points = (shell.POINTS_OF_LAYERS + 1) * len(of.walls.quads)
    return memory.virgin(law, points, relaxing_shear.LINE)


def stored(of: Structure, x: Floats, law: RelaxingSheet = LINEAR) -> Floats:
    """Membrane, bending and shear energy in J."""
    parts, room, g = np.zeros(3), shell.make_scratch(), np.zeros_like(x)
    energy = shell.evaluate(x, of.frames, of.walls, law, virgin(of, law), room, g, parts)
    np.testing.assert_allclose(parts.sum(), energy, rtol=1e-12, atol=1e-300)
    return parts


def element_hessians(of: Structure, x: Floats, law: RelaxingSheet = LINEAR) -> Floats:
    """Hessians (m, 24, 24) of all elements."""
    room, found = shell.make_scratch(), np.empty((len(of.walls.quads), 24, 24))
    for e in range(len(found)):
        shell.hessian(x, of.frames, of.walls, law, virgin(of, law), e, room, found[e])
    return found


def term_of(of: Structure, law: RelaxingSheet = LINEAR) -> Term:
    """Energy of the shells with dense derivatives."""
    room, memory = shell.make_scratch(), virgin(of, law)

    def slope(x: Floats, g: Floats) -> float:
        return float(shell.evaluate(x, of.frames, of.walls, law, memory, room, g, np.zeros(3)))

    def second(x: Floats) -> Floats:
        full = np.zeros((x.size, x.size))
        for nodes, own in zip(of.walls.quads, element_hessians(of, x, law), strict=True):
            at = (6 * nodes[:, None] + np.arange(6)).ravel()
            full[np.ix_(at, at)] += own
        return full

    return Term(slope, second)


def at_rest(of: Structure, x: Floats) -> Structure:
    """The structure whose shape without stress is ``x``."""
    walls = of.walls._replace(
        rest=np.zeros_like(of.walls.rest), shear_rest=np.zeros_like(of.walls.shear_rest)
    )
    shell.measure_rest(x, of.frames, walls, shell.make_scratch())
    return Structure(of.points, of.frames, walls)


def mapped(of: Structure, motion: Callable[[Floats], Floats]) -> Floats:
    """Rest coordinates with positions moved by ``motion`` of points (n, 3)."""
    x = of.rest
    x[:-2].reshape(-1, 6)[:, :3] = motion(of.points)
    return x
