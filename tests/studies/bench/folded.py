"""The matrix of folded cells, in our own factor and in CHOLMOD's."""

from contextlib import suppress
from functools import partial

import numpy as np
from scipy.sparse import csc_array

from kernels.compile.reference import by_reference, referred
from kernels.linear.pivots import ROUNDED
from kernels.linear.supernodal import factor as ldlt
from kernels.linear.supernodal import solution
from kernels.plates.problem import Plates
from kernels.solve.problem import POSITIVE, Step
from sweep.config.case import Case
from sweep.scene.loading import stages
from sweep.scene.plates.scene import build_scene
from tests.studies.bench import cholmod
from tests.studies.bench.measuring import marching
from tests.studies.bench.measuring.clock import medians, seconds
from tests.studies.bench.table import Table
from tests.support.kernels.pressed_plates import WholeOfPlates
from tests.support.kernels.solving import neighbours_of
from tests.support.kernels.terms import nowhere

UNKNOWNS, FACTOR, SOLVE = COLUMNS = ("unknowns", "factor, ms", "solution, ms")
PEER = "CHOLMOD"


def along(kind, cells, strain, steps):
    """Cells of 6 mm, 12 mm high, pressed along by glued platens."""
    size = 6e-3 * cells
    return Case.of(
        lattice=dict(
            kind=kind, cells_x=cells, cells_y=cells, width=size, height=size, depth=12e-3,
            mass=1.25e-4 * cells**2,
        ),
        material=dict(name="ninjaflex"),
        loading=dict(
            mode="displacement", direction="out_of_plane", strain=strain, unload=False
        ),
        solver=dict(load_steps=steps),
    )  # fmt: skip


class Ours:
    """The matrix where a case is loaded, with the interface of `cholmod.Peer`."""

    def __init__(self, case):
        scene = build_scene(case)
        state = scene.at_rest()
        marching.go(case, scene, state, [stages(case, scene)[0].stage])
        x, terms = state.x, scene.terms
        problem = Plates(
            by_reference(terms), by_reference(neighbours_of(x, terms)),
            by_reference(terms.make_buffers(state.memory)),
        )  # fmt: skip
        whole = WholeOfPlates(problem, Step(x, x, x, 1.0, 1.0, False, 0.0, 1.0, 1.0, 0.0))
        problem.begin(whole.step, nowhere(x.size), np.zeros(x.size))
        if whole.factored(x)[0] != POSITIVE:
            raise ArithmeticError("the matrix is not positive definite")
        self._layout, self._whole = terms.layout, whole
        self.matrix = referred(whole.neighbours).matrix

    def factor(self):
        """Factor the matrix."""
        layout = self._layout
        ldlt.factor(self.matrix, layout.scale, layout.weight, 0.0, ROUNDED)

    def solve(self, b):
        """Solution (u,) for a right side ``b`` (u,) after `factor`."""
        y = b.copy()
        solution.solve(self.matrix, y)
        return y

    def lower(self):
        """Lower half of the matrix, by place."""
        matrix, parts = self.matrix, []
        for s, panel in enumerate(matrix.panel[:-1]):
            own = np.arange(matrix.column[s], matrix.column[s + 1])
            rows = np.append(own, matrix.row[matrix.lower[s] : matrix.lower[s + 1]])
            for k, column in enumerate(own):
                at = panel + k * rows.size
                values = matrix.values[at + k : at + rows.size]
                parts.append((values, rows[k:], np.full(rows.size - k, column)))
        values, rows, columns = (np.concatenate(part) for part in zip(*parts, strict=True))
        entries = csc_array((values, (rows, columns)))
        entries.eliminate_zeros()
        return entries


def table(chosen, count):
    """Two rows for each case by name: ours, and CHOLMOD's with the ratio to ours."""
    measured = Table("pressed along by 30 %, 2 x 2 cells", COLUMNS)
    for name, case in chosen.items():
        ours, peer = Ours(case), f"{name}, {PEER}"
        sides = {name: ours}
        with suppress(ImportError):
            sides[peer] = cholmod.Peer(ours.lower())
        b = np.random.default_rng(1).uniform(-1.0, 1.0, ours.matrix.home.size)
        calls = {}
        for row, side in sides.items():
            side.factor()
            calls[row, FACTOR] = partial(seconds, side.factor)
            calls[row, SOLVE] = partial(seconds, partial(side.solve, b))
        at = medians(calls, count)
        for row in sides:
            measured.put(row, UNKNOWNS, b.size)
            for column in (FACTOR, SOLVE):
                ratio = at[row, column] / at[name, column]
                measured.put(row, column, 1e3 * at[row, column], f"{ratio:.3g} x")
        if peer not in sides:
            measured.lack(peer, "not installed")
    return measured
