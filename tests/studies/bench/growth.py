"""How the cost of an iteration, of the preparation and of the memory grows with the lattice."""

from functools import partial

import numpy as np

from kernels.planar import neighbour_lists
from kernels.terms import friction
from sweep.scene.lattice import build_scene
from tests.studies.bench.measuring import cases, marching
from tests.studies.bench.measuring.alone import MEMORY, alone
from tests.studies.bench.measuring.clock import medians, seconds
from tests.studies.bench.table import Table

STRAIN = 0.1  # buckled, and nothing touches
EACH, RATIO, TOTAL, ITERATIONS, SCENE, PATTERN, PEAK = (
    "µs an iteration",
    "times that of the size before",
    "the march, s",
    "its iterations",
    "building the scene, ms",
    "pattern of the matrix, ms",
    "memory of the process, MB",
)


def exponent(sizes, times):
    """Power of the cells a side with which times grow, fitted over all sizes."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])


def _search(scene):
    """List pairs and make the system, as every march does once."""
    pairs = neighbour_lists.list_neighbours(scene.terms, scene.x_rest, 0.0)[0]
    neighbour_lists.make_system(scene.terms, scene.x_rest, pairs, friction.none())


def table(sizes, steps, count):
    """Time and memory by size; the last column has the exponents."""
    found, before = Table(f"pressed to 10 % in {steps} steps", (*sizes, "power")), None
    for cells in sizes:
        case = cases.crush(cells, STRAIN, steps)
        scene = build_scene(case)
        march = partial(marching.whole, case, scene)
        often = march().iterations
        sides = {
            EACH: partial(marching.sustained, march),
            SCENE: partial(seconds, partial(cases.new_scene, case)),
            PATTERN: partial(seconds, partial(_search, scene)),
        }
        at = medians(sides, count)
        found.put(EACH, cells, 1e6 * at[EACH])
        if before:
            found.put(RATIO, cells, at[EACH] / before)
        else:
            found.lack(RATIO, "")
        found.put(TOTAL, cells, at[EACH] * often)
        found.put(ITERATIONS, cells, often)
        found.put(SCENE, cells, 1e3 * at[SCENE])
        found.put(PATTERN, cells, 1e3 * at[PATTERN])
        found.put(PEAK, cells, alone(case)[MEMORY])
        before = at[EACH]
    for name in (EACH, SCENE, PATTERN):
        times = [found.values[name, cells] for cells in sizes]
        found.put(name, "power", exponent(sizes, times))
    return found
