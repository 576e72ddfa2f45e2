"""Whole cases: one call of `simulate`, and the march in it by the iteration."""

from functools import partial

from sweep.scene import build_scene
from sweep.simulate import simulate
from tests.bench import cases, marching, opensees
from tests.bench.clock import medians, seconds
from tests.bench.crushes import COLLAPSED, Crush
from tests.bench.table import Table

WHOLE, SCENE, ITERATIONS, EACH = "CPU s", "building, ms", "iterations", "µs an iteration"
COLUMNS = (WHOLE, SCENE, ITERATIONS, EACH)  # in brackets: ratio to the first row
SEED = "5 N, no contact"
VARIANTS = {
    SEED: {},
    "contact allowed, nothing touches": {"contact": cases.SMOOTH},
    "friction too, nothing touches": {"contact": cases.ROUGH},
}
FULL = "the full model"
LEFT_OUT = {
    FULL: {},
    "without contact": {"contact": cases.APART},
    "without damping": {"damping": cases.UNDAMPED},
    "without friction": {"contact": cases.SMOOTH},
    "with a linear law": {"material": cases.MATERIAL},
}


def compared(title, chosen, count):
    """A row for each of the ``chosen`` cases."""
    found, sides, iterations = Table(title, COLUMNS), {}, {}
    for name, case in chosen.items():
        scene = build_scene(case)
        iterations[name] = marching.whole(case, scene).iterations
        sides[name, WHOLE] = partial(seconds, partial(simulate, case))
        sides[name, SCENE] = partial(seconds, partial(build_scene, case))
        sides[name, EACH] = lambda case=case, scene=scene: marching.whole(case, scene).each
    at, first = medians(sides, count), next(iter(chosen))
    for name in chosen:
        _row(found, name, iterations[name], {c: (at[name, c], at[first, c]) for c in (WHOLE, EACH)})
        found.put(name, SCENE, 1e3 * at[name, SCENE])
    return found


def _row(table, name, iterations, times):
    """Enter a row: times (own, of the first row) by column."""
    for column, (own, first) in times.items():
        value = 1e6 * own if column == EACH else own
        table.put(name, column, value, f"{own / first:.3g} x")
    table.put(name, ITERATIONS, iterations)


def seed(duration, count):
    """The seed's scene, and OpenSees with it where that is installed."""
    chosen = {name: cases.seed(duration, **given) for name, given in VARIANTS.items()}
    found = compared("the seed's scene, 3 x 3", chosen, count)
    case = chosen[SEED]
    return found
