"""Measure everything and print it as Markdown: `make bench`.

python -m tests.studies.bench FOLDER
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from sweep.simulation.warm_up import warm_up
from tests.studies.bench import densify, folded, growth, scenes, starts, sweeps
from tests.studies.tables import tell

SIZES, TWO, COUNT = (3, 5, 10, 20, 40), (3, 20), 7


def tables():
    """All tables, each as soon as it is measured."""
    yield starts.table()
    yield scenes.seed(3, 0.2, COUNT)
    yield scenes.seed(20, 0.01, 3, {}, scenes.LARGER)
    yield scenes.left_out(200, COUNT)
    yield growth.table(SIZES, 50, COUNT)
    yield scenes.collapse(TWO, COUNT)
    yield densify.table(40, 0.6, 200)
    chosen = {kind: folded.along(kind, 2, 0.3, 50) for kind in ("square", "hex")}
    # In a process without OpenSees, whose slow BLAS would serve CHOLMOD too.
    with ProcessPoolExecutor(1, get_context("spawn")) as apart:
        yield apart.submit(folded.table, chosen, 31).result()
    yield sweeps.throughput(sweeps.thousand(), 41)


def main(folder):
    """Print every table as it is found; write them to a folder."""
    warm_up()
    tell((text for table in tables() for text in (*table.markdown(), "")), folder / "bench.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
