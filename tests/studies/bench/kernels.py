"""Every kernel of an iteration, in a lattice that has collapsed, with all there is switched on."""

from functools import partial

from sweep.scene.lattice import build_scene
from sweep.scene.terms import time_step
from tests.studies.bench.measuring import cases, loops
from tests.studies.bench.measuring.clock import medians
from tests.studies.bench.measuring.crushes import COLLAPSED, Crush
from tests.studies.bench.measuring.spot import Spot
from tests.studies.bench.sweeps import changed
from tests.studies.bench.table import Table

PARTS = {
    "an evaluation": loops.EVALUATE,
    "- shape of the elements": loops.SHAPE,
    "- stretch": loops.STRETCH,
    "- bend": loops.BEND,
    "- fold": loops.FOLD,
    "- inertia": loops.INERTIA,
    "- damp": loops.DAMP,
    "- contact": loops.CONTACT,
    "- friction": loops.FRICTION,
    "a factor": loops.FACTOR,
    "- contact's Hessian": loops.CONTACT_HESSIAN,
    "- condense the walls": loops.WALLS,
    "- factor the blocks": loops.BLOCKS,
    "a solution": loops.SOLVE,
    "how far a step may go": loops.LIMIT,
}


def spot(cells):
    """A crush at a speed, at the first strain of `COLLAPSED`, with the mesh of that crush."""
    crushed = Crush(cells, cases.SMOOTH, COLLAPSED)
    full = changed(cases.blow(cells), solver={"joints": "points"})
    return Spot(build_scene(full), crushed.state.x, crushed.move, time_step(full))


def table(sizes, count):
    """µs a call, and % of the evaluation or the factor that it is part of."""
    found = Table("every kernel at 55 % strain, µs a call (% of its whole)", sizes)
    for cells in sizes:
        at = spot(cells)
        sides = {name: partial(at.each, which) for name, which in PARTS.items()}
        times, of = medians(sides, count), 0.0
        for name, time in times.items():
            part = name.startswith("-")
            of = of if part else time
            found.put(name, cells, 1e6 * time, f"{100 * time / of:.0f}" if part else "")
    return found
