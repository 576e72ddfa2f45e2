"""Designs that `crumple optimize` finds, against a scan and a grid, for five seeds.

Run by `make search`. The cushion is the README's own design, pressed between loose plates, to
absorb the most energy up to 50 N. Where walls just do not buckle at 50 N, a little more thickness
loses four fifths of it. Finished cases are kept in the given folder.

peak: a hexagon of 4 x 2 cells, walls of 0.3 to 1.2 mm, against a scan of 60 walls. cushion: all of
`configs/search.toml`, against two grids of 36 designs, one of which is lucky.
"""

import sys
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from sweep.config.axis import Interval, Written
from sweep.config.case import Case
from sweep.config.grid import Config, chosen_case
from sweep.config.load import load_config
from sweep.numbers import three_digits
from sweep.ranking.assessment import assess
from sweep.ranking.question import Question
from sweep.report.tables.sheet import Sheet
from sweep.running.searching.design_space import DesignSpace
from sweep.running.searching.search import Search, Settings
from tests.studies.tables import publish
from tests.support.converged import swept

CONFIG = Path(__file__).parents[3] / "configs" / "search.toml"
ENERGY = "absorbed_energy_at_50N_J"
QUESTION = Question(by=ENERGY, allowed_force="50 N")
SEEDS = (1, 2, 3, 4, 5)
KEYS = ("lattice.kind", "lattice.cells_x", "lattice.cells_y", "lattice.wall_thickness")
WALLS = KEYS[-1]
THIN, THICK = 0.3e-3, 1.2e-3  # m
KINDS = ("square", "hex", "diamond")


class Question(NamedTuple):
    """A search, the designs it is compared with, by name, and the evaluations of the search."""

    name: str
    search: Config
    beside: dict[str, list[Case]]
    evaluations: int


def written(*values):
    """The values of one design: key -> value in SI."""
    return {key: Written(value, str(value), key) for key, value in zip(KEYS, values, strict=False)}


def peak():
    """The hexagon, whose only freedom is the thickness of its walls."""
    config = load_config(CONFIG)
    scan = [
        chosen_case(config.recipe, written("hex", 4, 2, float(walls)))
        for walls in np.linspace(THIN, THICK, 60)
    ]
    search = {WALLS: Interval(WALLS, THIN, THICK, "m")}
    hexagon = replace(
        config,
        recipe=replace(
            config.recipe, base=config.recipe.base | written("hex", 4, 2), search=search
        ),
    )
    return Question("peak", hexagon, {"a scan of 60 walls": scan}, 30)


def cushion():
    """Four freedoms, three of which are choices."""
    config = load_config(CONFIG)
    grids = {
        "a grid": product(KINDS, (4, 6), (2, 3), (0.4e-3, 0.8e-3, 1.2e-3)),
        "another grid": product(KINDS, (2, 4, 6), (2, 4), (0.6e-3, 1.0e-3)),
    }
    beside = {
        name: [chosen_case(config.recipe, written(*point)) for point in points]
        for name, points in grids.items()
    }
    return Question("cushion", config, beside, 35)


def found(question, seed, folder, simulate=None, evaluations=None):
    """The best value (J) of a search, and its design."""
    settings = Settings(evaluations or question.evaluations, seed)
    out = folder / f"{question.name}_{seed}.h5"
    search = Search(DesignSpace(question.search), QUESTION, out, settings, simulate)
    best, value = next(iter(search.run().by_id.items()))
    return value, search.cases[best]


def best_beside(question, folder, simulate=None):
    """The best value (J) of each group of designs that a search is compared with, and the
    design.
    """
    every = [case for cases in question.beside.values() for case in cases]
    out = folder / f"{question.name}_beside.h5"
    values = assess(swept(every, out, simulate), QUESTION).by_id
    return {
        name: max(
            ((values[case.case_id], case) for case in cases if case.case_id in values),
            key=lambda pair: pair[0],
        )
        for name, cases in question.beside.items()
    }


def sheet(question, beside, searches):
    """A row for each group of designs that the search is compared with, and one for each seed."""
    heads = ["", "designs", "energy mJ", "of the first %", "design"]
    reference = next(iter(beside.values()))[0]
    rows = [
        [name, str(len(question.beside[name])), *row_of(*one, reference)]
        for name, one in beside.items()
    ]
    for seed, one in zip(SEEDS, searches, strict=False):
        rows.append([f"search, seed {seed}", str(question.evaluations), *row_of(*one, reference)])
    return Sheet(f"Energy to 50 N: {question.name}", heads, rows)


def row_of(value, case, reference):
    """Energy, its share of a reference, and the design in words."""
    lattice = case.lattice
    cells = f"{lattice.kind} {lattice.cells_x} x {lattice.cells_y}"
    words = f"{cells}, {1e3 * lattice.wall_thickness:.3f} mm"
    return three_digits(1e3 * value), f"{100 * value / reference:.1f}", words


def main(folder):
    """Run the missing cases, and print both tables."""
    folder.mkdir(parents=True, exist_ok=True)
    sheets = []
    for question in (peak(), cushion()):
        beside = best_beside(question, folder)
        sheets.append(sheet(question, beside, [found(question, s, folder) for s in SEEDS]))
    publish(sheets, folder / "search.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
