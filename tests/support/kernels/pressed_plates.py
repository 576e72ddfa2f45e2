"""The inside of a step of a tube that is pressed along its cell, as tests reach it.

`CASES` are four tubes of 3 x 6 quads a wall with the same kinds of arrays, so that one program
serves them all: glued to a driven platen that presses on folds too, the same with a material that
relaxes, the quarter of a tube between loose platens, and a tube glued to a striker that flies.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from kernels.compile.reference import by_reference, referred
from kernels.linear.supernodal.matrix import place
from kernels.plates import potential
from kernels.plates.element import shell
from kernels.plates.problem import Plates
from kernels.solve.problem import NO_ROOM, Step
from sweep.config.case import Case
from sweep.scene.plates.scene import build_scene
from tests.support.designs.tables import material_with
from tests.support.kernels.solving import Whole, neighbours_of
from tests.support.kernels.terms import nowhere

SIDE, T = 4e-3, 0.4e-3
LINEAR = material_with(name="ultimaker_tpu95a", stretch="linear")
RELAXING = material_with(name="ultimaker_tpu95a", stretch="linear", loss=0.4)
MOVED = 0.02  # of a quad, in a step that ends in a state
DT = 1e-4


def tube(loading, symmetry="none", steps=20, friction=0.3, material=LINEAR):
    """A case of a square tube of 4 x 4 x 8 mm with walls of 0.4 mm."""
    return Case.of(
        lattice=dict(
            cells_x=1, cells_y=1, nodes_per_wall=5 if symmetry == "quarter" else 2, layers=6,
            width=SIDE, height=SIDE, depth=2 * SIDE, wall_thickness=T, imperfection=0.05,
            symmetry=symmetry,
        ),
        material=material,
        loading=dict(direction="out_of_plane", **loading),
        contact=dict(friction=friction),
        solver=dict(load_steps=steps) if loading["mode"] == "displacement" else {},
    )  # fmt: skip


DRIVEN = {"mode": "displacement", "strain": 0.4, "unload": False}
STRUCK = {"mode": "impact", "striker_mass": 0.02}
CASES = {
    "glued": tube(DRIVEN | {"platen": "glued"}),
    "relaxing": tube(DRIVEN | {"platen": "glued"}, material=RELAXING),
    "loose quarter": tube(DRIVEN | {"platen": "contact"}, "quarter"),
    "struck": tube(STRUCK | {"platen": "glued"}),
}


@cache
def scene(name):
    """The scene of one of `CASES`."""
    return build_scene(CASES[name])


def unit(of):
    """Size of a coordinate (n,): the side of a quad for lengths, 0.3 for rotations."""
    return np.where(of.terms.coordinates.scale == 1.0, of.mesh.size.mean(), 0.3)


def shaken(of, x, seed, amount):
    """State ``x`` with all free coordinates moved at random, in units of each coordinate."""
    move = amount * unit(of) * np.random.default_rng(seed).uniform(-1, 1, x.size)
    return x + np.where(of.terms.layout.leader >= 0, move, 0.0)


def bent(of, seed=0):
    """Not far from rest: nothing touches but platens."""
    return pressed(of, shaken(of, of.x_rest, seed, 0.1))


def pinched(of, seed=0):
    """The walls at the left and at the right bulge until they touch; platens press."""
    x, middle, mesh = of.x_rest.copy(), 0.5 * SIDE, of.mesh
    points = x[:-2].reshape(-1, 6)
    inner = mesh.flat & (mesh.level > 1) & (mesh.level < 5)
    side = np.sign(mesh.rest[:, 0] - middle)
    bulging = inner & (np.abs(np.abs(mesh.rest[:, 0] - middle) - middle) < 0.3 * T)
    points[bulging, 0] = middle + 0.22 * T * side[bulging]
    return pressed(of, shaken(of, x, seed, 0.02))


STATES = {"bent": bent, "pinched": pinched}


def pressed(of, x):
    """The platens moved to where they touch the outermost nodes that may touch them."""
    touch, points = of.terms.contact, x[:-2].reshape(-1, 6)
    x[touch.low] = points[touch.low_nodes, 2].min() - 0.3 * T
    x[touch.high] = points[touch.high_nodes, 2].max() + 0.3 * T
    return x


@dataclass(frozen=True)
class WholeOfPlates(Whole):
    """All that a step minimises, as one term, with the matrix of its unknowns."""

    def factored(self, x, shift=0.0, through=False):
        """Result of `factor` at ``x``, and the negative pivot."""
        _, found = self.found(x)
        met, pivot = self.problem.factor(x, self.step, found, 0.0, through)
        if shift > 0.0:
            met, pivot = self.problem.factor(x, self.step, found, shift, through)
        assert met != NO_ROOM
        return met, pivot

    def entries(self):
        """Hessian (u, u) of the unknowns, from the matrix of the last `factored`."""
        matrix, layout = referred(self.neighbours).matrix, self.terms.layout
        first = np.cumsum(layout.size) - layout.size
        full = np.zeros((layout.size.sum(),) * 2)
        for i, height in enumerate(layout.size):
            for j, width in enumerate(layout.size[: i + 1]):
                at, down, across = place(matrix, i, j)
                if at >= 0:
                    to = at + down * np.arange(height)[:, None] + across * np.arange(width)
                    full[first[i] : first[i] + height, first[j] : first[j] + width] = matrix.values[
                        to
                    ]
        return np.tril(full) + np.tril(full, -1).T


def whole(of, x, seed=0, past=True):
    """A step that ends in ``x``, from nearby; with inertia under a striker. past: of a material
    that relaxes.
    """
    terms, dynamic = of.terms, of.terms.coordinates.driven < 0
    x0 = shaken(of, x, 100 + seed, MOVED)
    neighbours = neighbours_of(x, terms)
    problem = Plates(
        by_reference(terms), by_reference(neighbours),
        by_reference(terms.make_buffers(of.at_rest().memory)),
    )  # fmt: skip
    h = DT if dynamic else 1.0
    step = Step(x0, x0, 2.0 * x0 - x if dynamic else x0, h, h, dynamic, 0.7, 0.5, 1.0, 0.0)
    if past and of.terms.law.shares.size > 0:
        _remember(problem, step, of, seed)
    problem.begin(step, nowhere(x.size), np.zeros(x.size))
    return WholeOfPlates(problem, step)


def _remember(problem, step, of, seed):
    """Commit two earlier steps of a material that relaxes; the coordinates are not re-based."""
    buffers = referred(problem.buffers)
    for k in range(2):
        before = shaken(of, step.x0, 200 + 10 * seed + k, MOVED)
        potential.recall(problem, before, step.duration)
        shell.commit(
            before, buffers.committed, of.terms.shell, of.terms.law, buffers.memory,
            buffers.shell, np.zeros(3),
        )  # fmt: skip


def slope(function, x, move, step):
    """Fourth-order difference of ``function`` at ``x`` along ``move``, in steps of its share."""
    near, far = (function(x + k * step * move) - function(x - k * step * move) for k in (1, 2))
    return (8 * near - far) / (12 * step)


def hessian_error(of, x, seed, step):
    """Greatest error of the matrix times a random move of the unknowns, over the greatest entry of
    the product; step: of the differences.
    """
    args, R = whole(of, x), reduction(of)
    args.factored(x, through=True)
    size = R.T @ unit(of)
    move = size * np.random.default_rng(seed).uniform(-1, 1, size.size)
    difference = size * (R.T @ slope(args.gradient, x, R @ move, step))
    expected = size * (args.entries() @ move)
    return np.abs(difference - expected).max() / np.abs(expected).max()


def reduction(of):
    """Matrix (n, u): moves of all coordinates by the moves of the unknowns."""
    layout = of.terms.layout
    R = np.zeros((layout.unknown.size, layout.size.sum()))
    follows = layout.unknown >= 0
    R[follows, layout.unknown[follows]] = layout.ratio[follows]
    return R
