"""Simulate stiff and extreme scenes under observation, and count their outcomes.

The scenes are taken from `configs/extreme.toml`, with lattices that move by integrators of second
order or whose material has a memory, and custom structures. python -m tests.studies.stability
FOLDER [N]: the table is printed and written there, with a line a scene; with N, of every Nth scene
only.

Three kinds of scenes have no answer, and fail with a sentence about it. The load is less than
positions resolve: nothing moves by more than round-off. No contact keeps walls apart under a dead
load that would press a solid of their mass, of linear law, to less than half its height: they fold
flat, to no length. Or a striker or a platen is faster than sound in the walls: its wave front would
press a wall of linear law to no length. Shares refer to all scenes and to the scenes with an
answer. Lattices that tip over have one.
"""

import csv
import re
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from rich.console import Console
from rich.progress import track

from sweep.config.grid import expand
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.load import load_config
from sweep.design.lattice import build_network
from sweep.design.network import mass
from sweep.numbers import percent
from sweep.simulation.failures import faster_than_sound
from sweep.simulation.warm_up import warm_up
from tests.studies.stability.audit import audit
from tests.studies.stability.draw import CONFIGS, remembering, second_order, wide
from tests.studies.stability.structures import COUNT, structure_scene
from tests.studies.tables import head, line, tell

WORKERS = 2
KERNELS = "marches", "arcs"  # loaded before a scene is timed
MEMORIES = 150  # lattices whose material has a memory
SECOND_ORDER = 100  # numbers of lattices that are drawn for integrators of second order
WIDE = 64  # panels of up to 48 cells side by side
RETRIED = "converged in a retry"
TIPPED = "slipped"  # in a scene with flat platens: the lattice tipped over
DONE = "converged", RETRIED, TIPPED
UNANSWERED = "have no answer, of these"
ALL, VIOLATED, BALANCED = "all", "violated something", "steps balanced anew"
ROUND_OFF = "exceed round-off"  # in the message of a load that is too small
FLAT = 0.5  # strain of a solid under a load that folds walls flat
KINDS = (
    *("static", "in time", "dead load", "impact"),
    *("2nd order", "memory", "wide", "custom", ALL),
)
SECOND = "bdf2", "newmark"


def kind_of(case):
    """The loading of the lattice of a case, in words."""
    if isinstance(case.lattice, CustomStructure):
        return "custom"
    if case.lattice.cells_x >= 12 and case.lattice.cells_y == 3:
        return "wide"
    if case.material.remembers:
        return "memory"
    if case.solver.integrator in SECOND:
        return "2nd order"
    if case.loading.mode == "displacement":
        return "static" if case.loading.quasi_static else "in time"
    return {"force": "dead load", "impact": "impact"}[case.loading.mode]


def outcome(found):
    """Status of a scene, with its message if it stopped, except the place."""
    if found.status == "converged" and found.retry:
        return RETRIED
    if found.status != "stopped":
        return found.status.replace("_", " ")
    message = found.message.partition(" (tried without success")[0]
    why = re.split(r";|,| at strain | while ", message.split(":")[-1])[0]
    return f"stopped: {why.strip()}"


def has_no_answer(case, found):
    """Whether a scene that failed has no equilibrium or motion that could be resolved."""
    if outcome(found) in DONE:
        return False
    small = found.status == "stopped" and ROUND_OFF in found.message
    return small or _folds_flat(case) or faster_than_sound(case) != ""


def _folds_flat(case):
    """Whether a dead load is far above the strength of walls without contact."""
    if not isinstance(case.loading, DeadLoad) or case.contact.model != "none":
        return False
    lattice, modulus = case.lattice, case.material.modulus
    section = mass(build_network(lattice.geometry), lattice.depth, 1.0) / case.height
    return case.loading.force > FLAT * modulus * section


def counted(cases, audits):
    """Rows of the table: how many scenes of each kind ended in which way, and their violations."""
    counts = {}
    for case, found in zip(cases, audits, strict=True):
        for kind in (kind_of(case), ALL):
            row = counts.setdefault(outcome(found), Counter())
            row[kind] += 1
            counts.setdefault(UNANSWERED, Counter())[kind] += has_no_answer(case, found)
            counts.setdefault(VIOLATED, Counter())[kind] += len(found.violations) > 0
            counts.setdefault(BALANCED, Counter())[kind] += found.balanced
    last = [name for name in (UNANSWERED, VIOLATED, BALANCED) if name in counts]
    ended = sorted(counts.keys() - set(last), key=lambda name: (-counts[name][ALL], name))
    return {name: counts[name] for name in ended + last}


def shares(counts):
    """Rows of the table: the share of scenes that converge or tip over, in %, of all and of those
    with an answer.
    """
    ended = [name for name in counts if name not in (UNANSWERED, VIOLATED, BALANCED)]
    rows = {"done, % of all": [], "done, % of those with an answer": []}
    for kind in KINDS:
        total, done = (
            sum(counts[name][kind] for name in names if name in counts) for names in (ended, DONE)
        )
        for row, most in zip(rows.values(), (total, total - counts[UNANSWERED][kind]), strict=True):
            row.append(percent(done / most) if most else "-")
    return rows


def markdown(counts):
    """The table, a line of text each."""
    rows = {name: [row[kind] for kind in KINDS] for name, row in counts.items()} | shares(counts)
    return [*head(["scenes that", *KINDS]), *(line([name, *row]) for name, row in rows.items())]


def scenes():
    """The cases of all scenes."""
    lattices = (second_order(number) for number in range(SECOND_ORDER))
    return [
        *expand(load_config(CONFIGS / "extreme.toml")),
        *(case for case in lattices if case is not None),
        *(remembering(number) for number in range(MEMORIES)),
        *(wide(number) for number in range(WIDE)),
        *(structure_scene(number) for number in range(COUNT)),
    ]


def main(folder, every=1):
    """Print the table of every Nth scene; write it and, meanwhile, the outcome of each scene."""
    cases, audits = scenes()[::every], []
    folder.mkdir(parents=True, exist_ok=True)
    with (
        ProcessPoolExecutor(WORKERS, get_context("spawn"), warm_up, (KERNELS,)) as pool,
        (folder / "scenes.csv").open("w", newline="", encoding="utf-8", buffering=1) as file,
    ):
        rows = csv.writer(file)
        rows.writerow(("scene", "case_id", "status", "retry", "cpu_s", "violations", "message"))
        found = track(pool.map(audit, cases), "scenes", len(cases), console=Console(stderr=True))
        for case, seen in zip(cases, found, strict=True):
            told = seen.status, seen.retry, seen.cpu_s, "; ".join(seen.violations)
            rows.writerow((every * len(audits), case.case_id, *told, seen.message))
            audits.append(seen)
    tell(markdown(counted(cases, audits)), folder / "stability.md")
    return any(found.violations for found in audits)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *map(int, sys.argv[2:])))
