"""Solve every reference problem, print the table as Markdown and write it: `make validate`.

python -m tests.validation FOLDER
"""

import sys
from math import isnan
from pathlib import Path

from tests.validation import PROBLEMS
from tests.validation.problem import find

HEAD = ("problem", "truth", "source", "values at three meshes", "order", "error at the finest")
HEAD += ("extrapolated",)


def line(texts):
    """A row of the table."""
    return f"| {' | '.join(texts)} |"


def row(problem):
    """What a problem says."""
    found = find(problem)
    values = zip(problem.meshes, found.values, strict=True)
    return line(
        [
            problem.name,
            f"{found.truth:.6g}",
            problem.source,
            ", ".join(f"{value:.6g} ({mesh})" for mesh, value in values),
            "-" if isnan(found.order) else f"{found.order:.2f}",
            f"{100.0 * found.error:.2g} %",
            f"{100.0 * found.extrapolated:.1g} %",
        ]
    )


def main(folder):
    """Print the rows as they are found; write them to a folder."""
    lines = []
    for made in (lambda: line(HEAD), lambda: line(["---"] * len(HEAD)), *map(later, PROBLEMS)):
        lines.append(made())
        sys.stdout.write(f"{lines[-1]}\n")
        sys.stdout.flush()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "validation.md").write_text("\n".join([*lines, ""]), "utf-8")


def later(problem):
    """A problem, to be solved when its turn comes."""
    return lambda: row(problem)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
