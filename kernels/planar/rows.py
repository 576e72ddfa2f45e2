"""Where a march is, and the rows and frames that it writes of it."""

from typing import NamedTuple

import numpy as np

from kernels.geometry.specimen_height import height
from kernels.compile.jit import jit_exact
from kernels.arrays import total
from kernels.planar.potential import least_gap

TIME, HEIGHT, REACTION_TOP, REACTION_BOTTOM, ITERATIONS_DONE, GAP, SPEED = range(10, 17)
N_COLUMNS = 17
SPENT, STEPS, NOW, LAST = range(4)  # totals: iterations, steps, time, duration of a step


class State(NamedTuple):
    """Where the march is. x, v (n,): position and velocity. book (10,): energy book in J.

    rates (2, n), past (4, n): of position and velocity, gradients at the last step (`scheme`).
    stored (3,), held (2,): energies, driven reaction (N) and load factor at the last step. totals
    (4,): iterations, steps, time in s, duration of the last step, 0 to set out anew.
    """

    x: np.ndarray
    v: np.ndarray
    book: np.ndarray
    rates: np.ndarray
    past: np.ndarray
    stored: np.ndarray
    held: np.ndarray
    totals: np.ndarray


class Output(NamedTuple):
    """rows (steps, N_COLUMNS); frame_of (steps,): slot of a step in frames (f, n) or -1.

    bottom: coordinates whose supports make the lower reaction. top, base: see `height`. probed
    (steps, 2, k): value and reaction of the coordinates ``probes`` (k,).
    """

    rows: np.ndarray
    frame_of: np.ndarray
    frames: np.ndarray
    bottom: np.ndarray
    top: np.ndarray
    base: np.ndarray
    probes: np.ndarray
    probed: np.ndarray


@jit_exact
def write(out, k, state, terms, near, unknowns, at):
    """Write row ``k`` of the history and its frame."""
    row = out.rows[k]
    for c in range(TIME):
        row[c] = state.book[c]
    row[TIME] = state.totals[NOW]
    row[HEIGHT] = height(state.x, out.top, out.base)
    row[REACTION_BOTTOM] = 0.0
    for c in out.bottom:
        row[REACTION_BOTTOM] += at.g[c]
    row[REACTION_TOP] = -state.held[0]
    if unknowns.driven < 0:
        row[REACTION_TOP] = -state.held[1] * total(terms.load)
    for p in range(out.probes.size):
        out.probed[k, 0, p] = state.x[out.probes[p]]
        out.probed[k, 1, p] = at.g[out.probes[p]]
    row[ITERATIONS_DONE] = state.totals[SPENT]
    row[SPEED] = state.v[terms.contact.high]
    row[GAP] = least_gap(state.x, terms, near)
    if out.frame_of[k] >= 0:
        for i in range(state.x.size):
            out.frames[out.frame_of[k], i] = state.x[i]
