"""Results files of designs that never ran, for tests of their exports."""

from sweep.config.case import Case
from sweep.design.lattice import build_network
from sweep.design.network import mass, relative_density
from sweep.result import design_columns
from tests.support.results.specimens import summary, write


def row_of(case, **changes):
    """The row of a case, with its axes."""
    network = build_network(case.lattice.geometry)
    grams = 1e3 * mass(network, case.lattice.depth, case.material.density)
    density = relative_density(network, case.lattice.outer_size)
    known = {"case_id": case.case_id, "mass_g": grams, "relative_density": density}
    return design_columns(case) | known | case.axes | changes


def results(path, *cases):
    """A results file of these cases."""
    return write(path, summary(*(row_of(case) for case in cases)), cases=cases)


def grid(cells=3, **lattice):
    """A case with a square grid of 12.5 mm."""
    return Case.of(lattice=dict(cells_x=cells, cells_y=cells, **lattice))
