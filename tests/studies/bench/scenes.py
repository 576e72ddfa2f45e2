"""Whole cases: one call of `simulate`, and the march in it by the iteration."""

from contextlib import suppress
from functools import partial

from sweep.scene.lattice import build_scene
from sweep.simulation.simulate import simulate
from tests.studies.bench import opensees
from tests.studies.bench.measuring import cases, marching
from tests.studies.bench.measuring.clock import medians, seconds
from tests.studies.bench.measuring.crushes import COLLAPSED, Crush
from tests.studies.bench.table import Table

WHOLE, SCENE, ITERATIONS, EACH = "CPU s", "building, ms", "iterations", "µs an iteration"
COLUMNS = (WHOLE, SCENE, ITERATIONS, EACH)
SEED = "no contact"
PEERS = {"OpenSees, ProfileSPD": partial(opensees.Peer, solver="ProfileSPD")}
LARGER = {"OpenSees, SparseSYM": partial(opensees.Peer, solver="SparseSYM")}
ALLOWED = {
    "contact allowed, nothing touches": {"contact": cases.SMOOTH},
    "friction too": {"contact": cases.ROUGH},
}
LEFT_OUT = {
    "without contact": {"contact": cases.APART},
    "without damping": {"damping": cases.UNDAMPED},
    "without friction": {"contact": cases.SMOOTH},
    "with a linear law": {"material": cases.MATERIAL},
}


def compared(title, chosen, count, peers=None):
    """A row for each of the ``chosen`` cases and of the ``peers``, which march; in brackets the
    ratio to the first row.
    """
    sides, iterations = {}, {}
    for name, case in chosen.items():
        scene = build_scene(case)
        march = partial(marching.whole, case, scene)
        iterations[name] = march().iterations
        sides[name, WHOLE] = partial(seconds, partial(simulate, case))
        sides[name, SCENE] = partial(seconds, partial(cases.new_scene, case))
        sides[name, EACH] = partial(marching.sustained, march)
    for name, peer in (peers or {}).items():
        iterations[name] = peer.whole().iterations
        sides[name, WHOLE] = lambda peer=peer: peer.whole().seconds
    found, at, first = Table(title, COLUMNS), medians(sides, count), next(iter(chosen))
    for name, often in iterations.items():
        each = at.get((name, EACH), at[name, WHOLE] / often)
        whole = at[name, WHOLE]
        found.put(name, WHOLE, whole, f"{whole / at[first, WHOLE]:.3g} x")
        if name in chosen:
            found.put(name, SCENE, 1e3 * at[name, SCENE])
        found.put(name, ITERATIONS, often)
        found.put(name, EACH, 1e6 * each, f"{each / at[first, EACH]:.3g} x")
    return found


def seed(cells, duration, count, allowed=ALLOWED, beside=PEERS):
    """The seed's scene, in Crumple and in the other codes that are installed."""
    title = f"dead load, {cells} x {cells}, {round(1e4 * duration):,} steps"
    case = cases.seed(cells, duration)
    chosen = {SEED: case}
    chosen |= {what: cases.seed(cells, duration, **given) for what, given in allowed.items()}
    peers, scene = {}, build_scene(case)
    for name, peer in beside.items():
        with suppress(ImportError):
            peers[name] = peer(case, scene)
    found = compared(title, chosen, count, peers)
    for name in beside:
        if name not in peers:
            found.lack(name, "not installed")
    return found


def left_out(steps, count):
    """The cost of each part of a crush at a speed."""
    chosen = {"the full model": cases.blow(steps=steps)}
    chosen |= {name: cases.blow(steps=steps, **given) for name, given in LEFT_OUT.items()}
    return compared(f"pressed at {cases.SPEED} m/s to 60 %, 3 x 3, {steps} steps", chosen, count)


def collapse(sizes, count):
    """An iteration in full collapse, with contact and without."""
    found = Table("from 55 to 60 % strain, µs an iteration", sizes)
    for cells in sizes:
        pair = {"without contact": cases.APART, "with contact": cases.SMOOTH}
        sides = {name: Crush(cells, contact, COLLAPSED).each for name, contact in pair.items()}
        at = medians(sides, count)
        for name, time in at.items():
            found.put(name, cells, 1e6 * time, f"{time / at['without contact']:.2g} x")
    return found
