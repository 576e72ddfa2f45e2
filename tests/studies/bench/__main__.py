"""Measure everything, print it as Markdown, and draw it: `make bench`.

python -m tests.studies.bench FOLDER
"""

import sys
from pathlib import Path

from sweep.report.figures.case_plots import save
from sweep.simulation.simulate import warm_up
from tests.studies.bench import (
    densify,
    figure,
    growth,
    iteration,
    kernels,
    lockstep,
    scenes,
    starts,
    sweeps,
)
from tests.studies.bench.peers import libraries

SIZES, TWO, COUNT = (3, 5, 10, 20, 40), (3, 20), 7


def tables():
    """Names and functions of all tables."""
    designs = sweeps.thousand()
    yield "starts", starts.table
    yield "seed", lambda: scenes.seed(3, 0.2, COUNT)
    yield "seed 20", lambda: scenes.seed(20, 0.01, 3, {}, scenes.LARGER)
    yield "crush", lambda: scenes.crush(200, COUNT)
    yield "collapse", lambda: scenes.collapse(TWO, COUNT)
    yield "left out", lambda: scenes.left_out(200, COUNT)
    yield "growth", lambda: growth.table(SIZES, 50, COUNT)
    yield "split", lambda: iteration.table(TWO, COUNT)
    yield "kernels", lambda: kernels.table(TWO, COUNT)
    yield "factor", lambda: libraries.table((3, 5, 10, 20), COUNT)
    yield "lockstep", lambda: lockstep.table(sweeps.kinds(designs), 12)
    yield "overhead", lambda: sweeps.overhead(designs[::9], 3)
    yield "throughput", lambda: sweeps.throughput(designs, 41)
    yield "densify", lambda: densify.table(40, 0.6, 200)


def main(folder):
    """Print every table as it is found; write them and the figure to a folder."""
    warm_up()
    found, lines = {}, []
    for name, made in tables():
        found[name] = made()
        lines += [*found[name].markdown(), ""]
        sys.stdout.write("\n".join([*found[name].markdown(), "", ""]))
        sys.stdout.flush()
    drawn = figure.draw(*(found[name] for name in ("growth", "factor", "split", "seed")))
    save(drawn, folder / "bench.png")
    (folder / "bench.md").write_text("\n".join(lines), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
