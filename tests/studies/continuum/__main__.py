"""Compare the network with a solid of the same grid: `make continuum`.

python -m tests.studies.continuum FOLDER: tables are printed and written there, with a figure. Takes
ten minutes.
"""

import sys
from importlib.util import find_spec
from pathlib import Path

NEEDED = {"skfem": "scikit-fem", "ipctk": "ipctk"}


def table(head, rows):
    """Lines of a Markdown table."""
    yield f"| {' | '.join(head)} |"
    yield "|---" * len(head) + "|"
    yield from (f"| {' | '.join(row)} |" for row in rows)


def crush_table(sides, watched):
    """Force and energy of all sides, each with its error against the finest solid."""
    truth = sides[-1].at(watched)
    for side in sides:
        found = side.at(watched)
        cells = (
            f"{force:.2f} N ({100 * (force / force0 - 1):+.1f} %), "
            f"{energy:.1f} mJ ({100 * (energy / energy0 - 1):+.1f} %)"
            for force, force0, energy, energy0 in zip(
                found[0], truth[0], found[1], truth[1], strict=True
            )
        )
        yield [side.name, *cells]


def slender_table(rows):
    """Every slenderness: the finer solid, and how far others are off."""
    for row in rows:
        yield [f"{row.slenderness:g}", "finer solid", *(f"{value:.4g}" for value in row.truth)]
        for name, errors in row.errors.items():
            yield ["", name, *(f"{error:+.1f} %" for error in errors)]


def main(folder):
    """Print the tables; write them and the figure to a folder."""
    from sweep.report.case_plots import save
    from tests.studies.continuum import figure, study

    def told(lines):
        text = "\n".join([*lines, "", ""])
        sys.stdout.write(text)
        sys.stdout.flush()
        return text

    beyond = study.beyond_beams()
    text = told(table(("elasticity", *beyond), [["", *(f"{x:.3f}" for x in beyond.values())]]))
    rows = [study.compared(slenderness, beyond) for slenderness in study.SLENDER]
    units = ["N", *["N"] * len(study.APART), *["mJ"] * len(study.APART)]
    heads = [f"{name}, {unit}" for name, unit in zip(figure.NAMES, units, strict=True)]
    text += told(table(("t / L", "", *heads), slender_table(rows)))
    sides = list(study.crushed(beyond))
    heads = [f"{100 * strain:.0f} %" for strain in study.WATCHED]
    text += told(table(("strain", *heads), crush_table(sides, study.WATCHED)))
    save(figure.draw(sides, rows), folder / "continuum.png")
    (folder / "continuum.md").write_text(text, "utf-8")


def lacking():
    """What to install, in a sentence, if anything is."""
    absent = [package for module, package in NEEDED.items() if find_spec(module) is None]
    if not absent:
        return ""
    return f"make continuum needs {' and '.join(absent)}: install with pip or uv into .venv"


if __name__ == "__main__":
    if lacking():
        sys.exit(lacking())
    main(Path(sys.argv[1]))
