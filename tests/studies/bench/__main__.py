"""Measure everything and print it as Markdown: `make bench`.

python -m tests.studies.bench FOLDER
"""

import sys
from pathlib import Path

from sweep.simulation.simulate import warm_up
from tests.studies.bench import densify, growth, scenes, starts, sweeps

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
    yield sweeps.throughput(sweeps.thousand(), 41)


def main(folder):
    """Print every table as it is found; write them to a folder."""
    warm_up()
    lines = []
    for table in tables():
        lines += [*table.markdown(), ""]
        sys.stdout.write("\n".join([*table.markdown(), "", ""]))
        sys.stdout.flush()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "bench.md").write_text("\n".join(lines), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
