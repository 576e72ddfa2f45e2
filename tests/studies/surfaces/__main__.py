"""Moduli of a gyroid of shells against the solid wall, at three densities and five meshes.

Run by `make surfaces`. The material has modulus 1 and Poisson's ratio 0.3 or 0.45, the period is 1.
Shells become thinner as incompressible ones, whatever their ratio; trilinear bricks of more than
0.45 would lock.
"""

import sys
import time
from itertools import product

from sweep.design.surfaces.names import SHEETS
from tests.studies.surfaces import moduli, shells, wall
from tests.studies.surfaces.extrapolated import limit
from tests.studies.surfaces.period import best_period

GRIDS = {0.1: 48, 0.2: 32, 0.3: 32}
"""Solid share of the period, and the coarsest of three grids."""
MESHES = (8, 10, 12, 16, 24)
POISSON = (0.3, 0.45)


def _line(name, cells):
    """A row of a table."""
    return f"{name:38}" + "".join(f"{cell:>10}" for cell in cells)


def solid_lines(share, poisson, of):
    """Moduli on each grid, their limit, the order, and the error left in percent."""
    name = f"share {share:.0%}, Poisson {poisson:g}, t = {of.thickness:.4f}"
    yield _line(name, [*moduli.NAMES, "share"])
    for n, solid in of.rows:
        cells = [f"{m:.5f}" for m in solid.cubic.moduli]
        yield _line(f"  {n}^3 cubes", [*cells, f"{solid.density:.3%}"])
    yield _line("  limit", [f"{m:.5f}" for m in of.moduli])
    yield _line("  order", [f"{p:.2f}" for p in of.order])
    yield _line("  error left", [f"{e:.2%}" for e in of.error])


def shell_lines(poisson, of, nets):
    """Differences of shells from the solid in percent, as they are and for the exact area.

    The last column has the share of the period that they fill, their area times thickness.
    """
    for n, net in nets.items():
        stiffness, area = shells.stiffness(net, of.thickness, 1.0, poisson)
        cubic, _ = moduli.cubic(stiffness)
        for name, factor in (("", 1.0), (", by exact area", SHEETS["gyroid"].area / area)):
            away = factor * cubic.moduli / of.moduli - 1.0
            cells = [f"{100.0 * a:+.2f}%" for a in away]
            yield _line(f"  shells, n = {n}{name}", [*cells, f"{factor * area * of.thickness:.3%}"])


def main(out=sys.stdout):
    """Write all tables, and the time that they took."""
    start = time.process_time()
    nets = {n: best_period(n) for n in MESHES}
    out.write(_line("nets", ["quads", "area", "quality", "uneven"]) + "\n")
    for n, net in nets.items():
        stiffness, area = shells.stiffness(net, wall.thickness_of(0.1))
        cells = [len(net.quads), f"{area / SHEETS['gyroid'].area - 1.0:+.2%}", f"{net.quality:.2f}"]
        out.write(_line(f"  n = {n}", [*cells, f"{moduli.cubic(stiffness)[1]:.2%}"]) + "\n")
    for poisson, (share, n) in product(POISSON, GRIDS.items()):
        of = limit(share, n, poisson)
        for line in [*solid_lines(share, poisson, of), *shell_lines(poisson, of, nets)]:
            out.write(f"{line}\n")
        out.flush()
    out.write(f"CPU time {time.process_time() - start:.0f} s\n")


if __name__ == "__main__":
    main()
