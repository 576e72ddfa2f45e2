"""What marching alike designs in lockstep would cost: every lane waits for the slowest."""

from itertools import groupby

import numpy as np

from sweep.simulation.simulate import simulate
from tests.studies.bench.table import Table

LANES = 8


def topology(case):
    """What lanes must have in common."""
    return case.lattice.cells_x, case.lattice.cells_y, case.material.name


def slenderness(case):
    """Wall thickness / width of the specimen: what neighbours in a group differ by."""
    return case.lattice.wall_thickness / case.lattice.width


def lanes(designs):
    """Designs in lists of `LANES` of one topology, as alike as they come."""
    designs = sorted(designs, key=lambda case: (topology(case), slenderness(case)))
    for _, alike in groupby(designs, topology):
        alike = list(alike)
        for first in range(0, len(alike) - LANES + 1, LANES):
            yield alike[first : first + LANES]


def waiting(group):
    """Newton iterations that lockstep takes a step / those that a lane needs on the average."""
    needed = np.array([simulate(case).history["newton_iterations"] for case in group])
    return needed.max(axis=0).sum() / needed.mean(axis=0).sum()


def table(kinds, every):
    """The median over every so many groups of lanes, for named lists of designs."""
    columns = ("median", "least", "most", "groups")
    found = Table(f"iterations of {LANES} alike designs in lockstep / apart", columns)
    for name, designs in kinds.items():
        ratios = [waiting(group) for group in list(lanes(designs))[::every]]
        figures = np.median(ratios), min(ratios), max(ratios), len(ratios)
        for column, figure in zip(columns, figures, strict=True):
            found.put(name, column, float(figure))
    return found
