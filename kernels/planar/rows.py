"""Rows of the history and frames of a lattice."""

from kernels.arrays import total
from kernels.compile.jit import jit_exact
from kernels.geometry.specimen_height import height
from kernels.planar.reach import least_gap
from kernels.terms.rows import enter


@jit_exact
def write(problem, out, k, state, found):
    """Write row ``k`` of the history, and its frame if one is asked for."""
    row, totals, coordinates = out.rows[k], state.totals[0], problem.scene.coordinates
    enter(row, state)
    row.time, row.iterations = totals.time, totals.iterations
    row.height = height(state.x, out.top, out.base)
    row.reaction_bottom = 0.0
    for c in out.bottom:
        row.reaction_bottom += found.g[c]
    row.reaction_top = -totals.reaction
    if coordinates.driven < 0:
        row.reaction_top = -totals.factor * total(coordinates.load)
    for p in range(out.probes.size):
        out.probed[k, 0, p] = state.x[out.probes[p]]
        out.probed[k, 1, p] = found.g[out.probes[p]]
    row.speed = state.v[problem.scene.contact.high]
    row.gap = least_gap(problem, state.x)
    if out.frame_of[k] >= 0:
        for i in range(state.x.size):
            out.frames[out.frame_of[k], i] = state.x[i]
