"""Compare the network with a solid of the same grid: `make continuum`.

python -m tests.studies.continuum FOLDER: tables are printed and written there, with a figure. The
solids themselves are computed by tests.studies.continuum.solids.
"""

import sys
from pathlib import Path

from tests.studies.tables import head, line, tell


def lines(found):
    """The finest solid of a grid, and by how much others are off."""
    case = found.case
    cells = [f"{case.slenderness:g}", case.plane]
    yield [*cells, found.truth.name, *(f"{value:.4g}" for value in found.values())]
    for name, errors in found.errors():
        yield ["", "", name, *(f"{error:+.1f} %" for error in errors)]


def heads(strains):
    """Names of the columns."""
    units = [f"{100 * strain:.0f} %, {unit}" for unit in ("N", "mJ") for strain in strains]
    return ["t / L", "plane", "", *units]


def main(folder):
    """Print the tables; write them and the figure to a folder."""
    from sweep.report.figures.case_plots import save
    from tests.studies.continuum import figure, solids, study

    grids, crush = [study.compared(*pair) for pair in solids.PAIRS], study.packed()
    rows = [row for found in grids for row in lines(found)]
    found = [*head(heads(study.APART)), *map(line, rows), ""]
    found += [*head(heads(study.WATCHED)), *map(line, lines(crush))]
    tell(found, folder / "continuum.md")
    save(figure.draw(grids, crush), folder / "continuum.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
