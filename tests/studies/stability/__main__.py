"""Simulate stiff and extreme scenes under observation, and count what became of them.

They are those of `configs/extreme.toml`, lattices that move by integrators of second order or whose
material has a memory, and custom structures. python -m tests.studies.stability FOLDER [N]: the
table is printed and written there, with a line a scene; with N, of every Nth scene only.
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
from sweep.config.load import load_config
from sweep.simulation.simulate import warm_up
from tests.studies.stability.audit import audit
from tests.studies.stability.draw import CONFIGS, remembering, second_order, wide
from tests.studies.stability.structures import COUNT, structure_scene
from tests.studies.tables import head, line, tell

WORKERS = 2
MEMORIES = 150  # lattices whose material has a memory
SECOND_ORDER = 100  # numbers of lattices that are drawn for integrators of second order
WIDE = 64  # panels of up to 48 cells side by side
RETRIED = "converged in a retry"
ALL, VIOLATED, BALANCED = "all", "violated something", "steps balanced anew"
KINDS = (
    *("static", "in time", "dead load", "impact"),
    *("2nd order", "memory", "wide", "custom", ALL),
)
SECOND = "bdf2", "newmark"


def kind_of(case):
    """What is done to the lattice of a case, in words."""
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
    """Status of a scene, with what it says where it stopped, but for the place."""
    if found.status == "converged" and found.retry:
        return RETRIED
    if found.status != "stopped":
        return found.status.replace("_", " ")
    message = found.message.partition(" (tried without success")[0]
    why = re.split(r";|,| at strain ", message.split(":")[-1])[0]
    return f"stopped: {why.strip()}"


def counted(cases, audits):
    """Rows of the table: how many scenes of each kind ended in which way, and what they violate."""
    counts = {}
    for case, found in zip(cases, audits, strict=True):
        for kind in (kind_of(case), ALL):
            row = counts.setdefault(outcome(found), Counter())
            row[kind] += 1
            counts.setdefault(VIOLATED, Counter())[kind] += len(found.violations) > 0
            counts.setdefault(BALANCED, Counter())[kind] += found.balanced
    last = [name for name in (VIOLATED, BALANCED) if name in counts]
    ended = sorted(counts.keys() - set(last), key=lambda name: (-counts[name][ALL], name))
    return {name: counts[name] for name in ended + last}


def markdown(counts):
    """The table, a line of text each."""
    rows = (line([name, *(row[kind] for kind in KINDS)]) for name, row in counts.items())
    return [*head(["scenes that", *KINDS]), *rows]


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
    """Print the table of every Nth scene; write it and, while it goes on, what each scene did."""
    cases, audits = scenes()[::every], []
    folder.mkdir(parents=True, exist_ok=True)
    with (
        ProcessPoolExecutor(WORKERS, get_context("spawn"), warm_up) as pool,
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
