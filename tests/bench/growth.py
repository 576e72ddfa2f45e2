"""How an iteration, what comes before it and the memory grow with the lattice."""

from functools import partial
from math import log

import numpy as np

from kernels import friction, step
from sweep.scene import build_scene
from tests.bench.clock import medians, seconds
from tests.bench.crushes import Crush
from tests.bench.processes import memory
from tests.bench.table import Row

GROUP = "growth: past buckling, without contact"
TIMES = {
    "an iteration, µs": ("iteration", 1e6),
    "building the scene, ms": ("scene", 1e3),
    "order and pattern of the matrix, ms": ("pattern", 1e3),
}


def _sides(crush):
    given = crush.state.x, crush.scene.terms, friction.none(), 0.0
    return {
        "iteration": crush.each,
        "scene": partial(seconds, partial(build_scene, crush.case)),
        "pattern": partial(seconds, partial(step.find_near, *given)),
    }


def exponent(times):
    """Power of the cells a side with which times (by cells) grow, fitted over all of them."""
    return float(np.polyfit(np.log(list(times)), np.log(list(times.values())), 1)[0])


def _ratios(times):
    """Rows on how the time of an iteration grows from size to size, and over all."""
    apart, ratio = Row(GROUP, "times that of the size before"), Row(GROUP, "power, cells a side")
    overall = Row(GROUP, "the same, fitted over all sizes")
    sizes = list(times)
    for small, large in zip(sizes, sizes[1:], strict=False):
        apart.put(large, times[large] / times[small])
        ratio.put(large, log(times[large] / times[small]) / log(large / small))
    if len(sizes) > 1:
        overall.put(sizes[-1], exponent(times))
    return [apart, ratio, overall]


def rows(sizes, count):
    """Rows of the table."""
    timed = {what: Row(GROUP, what) for what in TIMES}
    blocks, updates = Row(GROUP, "3 x 3 blocks (below diagonal)"), Row(GROUP, "updates of blocks")
    held = Row(GROUP, "peak memory of a process, MB (above the smallest)")
    for cells in sizes:
        crush = Crush(cells)
        found = medians(_sides(crush), count)
        for what, (side, unit) in TIMES.items():
            timed[what].put(cells, unit * found[side])
        matrix = step.find_near(crush.state.x, crush.scene.terms, friction.none(), 0.0).system.matrix
        blocks.put(cells, matrix.start.size - 1, f"{matrix.row.size:,}")
        updates.put(cells, matrix.update.size)
        peak = memory(cells)
        held.put(cells, peak, f"{peak - held.values.get(sizes[0], peak):.0f}")
    iteration, *others = timed.values()
    times = {cells: value for cells, value in iteration.values.items()}
    return [iteration, *_ratios(times), *others, blocks, updates, held]
