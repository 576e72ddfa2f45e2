"""Compare the network with a solid of the same grid: `make continuum`.

python -m tests.studies.continuum FOLDER: tables are printed and written there, with a figure. The
solids themselves are computed by tests.studies.continuum.solids.
"""

import sys
from pathlib import Path


def table(head, rows):
    """Lines of a Markdown table."""
    yield f"| {' | '.join(head)} |"
    yield "|---" * len(head) + "|"
    yield from (f"| {' | '.join(row)} |" for row in rows)


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

    def told(lines):
        text = "\n".join([*lines, "", ""])
        sys.stdout.write(text)
        sys.stdout.flush()
        return text

    grids, crush = [study.compared(*pair) for pair in solids.PAIRS], study.packed()
    rows = [line for found in grids for line in lines(found)]
    text = told(table(heads(study.APART), rows))
    text += told(table(heads(study.WATCHED), lines(crush)))
    save(figure.draw(grids, crush), folder / "continuum.png")
    (folder / "continuum.md").write_text(text, "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
