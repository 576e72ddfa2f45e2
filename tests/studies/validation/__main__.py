"""Solve every reference problem, print the table as Markdown and write it: `make validate`.

python -m tests.studies.validation FOLDER
"""

import sys
from math import isnan
from pathlib import Path

from tests.studies.tables import head, line, tell
from tests.studies.validation import PROBLEMS, energy
from tests.studies.validation.problem import SOURCES, find

HEAD = ("problem", "source", "truth", "coarse", "middle", "fine", "order")
MORE = ("error, %", "extrapolated, %", "meshes")
NOTES = "\n".join(f"{source}: {more}." for source, more in SOURCES.items())


def row(problem, found):
    """The results of a problem: the cells of `HEAD`, then `MORE`, of the finest mesh."""
    return [
        problem.name,
        problem.source,
        *(f"{value:.5g}" for value in (found.truth, *found.values)),
        "-" if isnan(found.order) else f"{found.order:.2f}",
        f"{100.0 * found.error:.2g}",
        f"{100.0 * found.extrapolated:.1g}",
        ", ".join(map(str, problem.meshes)),
    ]


def main(folder):
    """Print the lines as they are found; write them to a folder."""
    tell(table(), folder / "validation.md")


def table():
    """Lines, each as soon as its problem is solved."""
    yield from head(HEAD + MORE)
    yield from (line(row(problem, find(problem))) for problem in PROBLEMS)
    yield f"\n{NOTES}\n"
    yield from head(energy.HEAD)
    yield from map(line, energy.rows())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
