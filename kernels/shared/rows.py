"""Rows and frames of a history: the energy book by terms, and measurements after each step.

They are the same for walls in the plane and for plates: a problem provides its `least_gap`.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import total
from kernels.compile.jit import jit_exact
from kernels.geometry.specimen_height import height

STRETCH, BEND, CONTACT = range(3)  # stored energies: E_s with springs, E_b with folds, E_c
STORED = 3
ROW = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            ("work", np.float64),  # the energy book, J: as in `history.BOOK`
            ("kinetic", np.float64),
            ("stretch", np.float64),
            ("bend", np.float64),
            ("contact", np.float64),
            ("material", np.float64),
            ("friction", np.float64),
            ("integrator", np.float64),
            ("injected", np.float64),
            ("residual", np.float64),
            ("time", np.float64),  # s
            ("height", np.float64),  # of the specimen, m
            ("reaction_top", np.float64),  # N
            ("reaction_bottom", np.float64),  # N
            ("iterations", np.float64),  # of Newton, accumulated
            ("gap", np.float64),  # least distance of axes that may touch, m; infinite: none
            ("speed", np.float64),  # of the upper platen upwards, m/s
            ("base_speed", np.float64),  # of the lower platen upwards, m/s
            ("patch_force", np.float64),  # greatest force on a patch of the base, N
            ("patch_at", np.float64),  # x of that force, m
            ("least_height", np.float64),  # of the specimen since the previous row, m
            ("most_force", np.float64),  # of the lower reaction since the previous row, N
        ],
    )
)


class Output(NamedTuple):
    """rows (steps,) of `ROW`; frame_of (steps,): slot of a step in frames (f, n), -1 for none; a
    later step overwrites the slot.

    bottom: coordinates whose reactions sum to the lower reaction. top, base: coordinates, see
    `height`. probes (k,): coordinates whose value and reaction are recorded in probed (steps, 2,
    k). standing (b,): nodes that may press on the base, sorted in place; patch: width of the patch
    of the base, m. pressing (b, 3): scratch for their places and forces.
    """

    rows: np.ndarray
    frame_of: np.ndarray
    frames: np.ndarray
    bottom: np.ndarray
    top: np.ndarray
    base: np.ndarray
    probes: np.ndarray
    probed: np.ndarray
    standing: np.ndarray
    pressing: np.ndarray
    patch: float


@jit_exact
def _enter(row, state):
    """Write the energy book of ``state`` into a row."""
    book = state.book[0]
    row.work, row.kinetic = book.work, book.kinetic
    row.stretch, row.bend = state.stored[STRETCH], state.stored[BEND]
    row.contact = state.stored[CONTACT]
    row.material, row.friction = book.material, book.friction
    row.integrator, row.injected, row.residual = book.integrator, book.injected, book.residual


@jit_exact
def write_share(problem, out, k, state, evaluation):
    """Write height and lower reaction at the end of a share of row ``k``, and update its extremes.

    `Output.rows` starts with an infinite least height and a greatest force of minus infinity.
    """
    row, low, parts = out.rows[k], problem.scene.contact.low, state.gradients
    row.height = height(state.x, out.top, out.base)
    row.reaction_bottom = 0.0
    for c in out.bottom:
        row.reaction_bottom += evaluation.g[c]
    if problem.scene.coordinates.mass[low] > 0.0:  # a base that moves: g has its inertia
        row.reaction_bottom += parts.elastic[low] + parts.friction[low] - evaluation.g[low]
    row.least_height = min(row.least_height, row.height)
    row.most_force = max(row.most_force, row.reaction_bottom)


@jit_exact
def write(problem, out, k, state, evaluation):
    """Write row ``k`` of the history, and its frame if `Output.frame_of` has a slot for it."""
    row, totals, coordinates = out.rows[k], state.totals[0], problem.scene.coordinates
    _enter(row, state)
    row.time, row.iterations = totals.time, totals.iterations
    low = problem.scene.contact.low
    write_share(problem, out, k, state, evaluation)
    row.reaction_top = -totals.reaction
    if coordinates.driven < 0:
        row.reaction_top = -totals.factor * total(coordinates.load)
    for p in range(out.probes.size):
        out.probed[k, 0, p] = state.x[out.probes[p]]
        out.probed[k, 1, p] = evaluation.g[out.probes[p]]
    row.speed, row.base_speed = state.v[problem.scene.contact.high], state.v[low]
    row.gap = problem.least_gap(state.x)
    if out.frame_of[k] >= 0:
        for i in range(state.x.size):
            out.frames[out.frame_of[k], i] = state.x[i]
