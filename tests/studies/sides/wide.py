"""Panels of 24 and 48 cells, pressed to half their height and back: do they all end, at which cost?

Run by `make wide`: all infills in 3 rows of cells of 4.17 mm and walls of 0.4 mm, and the patterns
of a slicer at equal mass, 100 x 12.5 mm; between glued platens and loose ones, and under a round
striker of 5 mm. The energy per gram of 24 cells is compared with specimens of 3 cells with free
sides and with tied ones. Finished cases are kept in the given folder.
"""

import sys
from pathlib import Path
from typing import NamedTuple

from sweep.config.case import Case
from sweep.design.infill import families
from sweep.report.tables.sheet import Sheet
from sweep.result import Status
from sweep.running.sweep import run_sweep
from sweep.store.read import read_summary
from tests.studies.sides.panels import STRAIN, Strip, crush
from tests.studies.tables import publish

WIDE, WIDEST, FEW = 24, 48, 3  # cells side by side
PLATENS, ROUND = ("glued", "loose"), "round"
PATTERNS = ("grid", "triangles", "stars", "honeycomb", "alignedrectilinear")
SLICED = {"slicer": "prusa", "width": 0.1, "height": 12.5e-3, "infill": 0.15, "perimeters": 1}
PRESS = {
    "glued": {"platen": "glued"},
    "loose": {"platen": "contact"},
    ROUND: {"platen": "contact", "striker": "round", "striker_radius": 5e-3},
}


class Panel(NamedTuple):
    """A specimen: its infill, its loading, its sides, and cells side by side; 0: a slicer's."""

    infill: str
    press: str
    cells: int
    sides: str = "free"


def panels(infills=None):
    """The panels of the study."""
    for kind in infills or families():
        yield from (Panel(kind, platens, n) for platens in PLATENS for n in (FEW, WIDE, WIDEST))
        yield from (Panel(kind, platens, FEW, "periodic") for platens in PLATENS)
        yield Panel(kind, ROUND, WIDE)
    if not infills:
        yield from (Panel(pattern, press, 0) for pattern in PATTERNS for press in PRESS)


def pressed(panel):
    """The crush of a panel and its unloading."""
    loading = PRESS[panel.press] | {"unload": True}
    if not panel.cells:
        lattice = SLICED | {"pattern": panel.infill}
        loading |= {"mode": "displacement", "strain": STRAIN}
        return Case.of(lattice=lattice, loading=loading, solver={"time_limit": 900.0})
    strip = Strip(panel.infill, "loose", panel.sides, panel.cells)
    return crush(strip).changed(loading=loading)


def table(rows):
    """A line for each infill and press; rows: of the summary, by `Panel`."""
    lines = []
    for infill, press in dict.fromkeys((panel.infill, panel.press) for panel in rows):
        few, tied, wide, widest, sliced = (
            rows.get(Panel(infill, press, *more))
            for more in ((FEW,), (FEW, "periodic"), (WIDE,), (WIDEST,), (0,))
        )
        panel = sliced if wide is None else wide
        line = [infill, press, f"{panel['newton_iterations']:.0f}", f"{panel['cpu_s']:.2g}"]
        line += [_ratio(widest, panel), _energy(panel)]
        lines.append([*line, _more(panel, few), _more(panel, tied)])
    failed = [panel for panel, row in rows.items() if row["status"] != Status.CONVERGED]
    named = (f"Stopped: {', '.join(' '.join(map(str, panel)) for panel in failed)}.",)
    return Sheet(
        "Panels of 24 cells",
        ["infill", "press", "iterations", "CPU s", "48 cells", "mJ/g", "3 free", "3 tied"],
        lines,
        notes=(
            f"To {100 * STRAIN:g} % and back. 48 cells: ratio of the processor time. 3 free, 3 "
            "tied: by how much more energy per gram they absorb than 3 cells, with free and "
            "with tied sides, in %. -: not simulated, or stopped.",
            f"{len(rows) - len(failed)} of {len(rows)} crushes converge.",
            *(named if failed else ()),
        ),
    )


def _energy(row):
    done = row is not None and row["status"] == Status.CONVERGED
    return f"{1e3 * row['specific_absorption_J_per_g']:.1f}" if done else "-"


def _more(row, other):
    energies = (_energy(row), _energy(other))
    return "-" if "-" in energies else f"{100 * (float(energies[0]) / float(energies[1]) - 1):+.1f}"


def _ratio(row, other):
    return "-" if "-" in (_energy(row), _energy(other)) else f"{row['cpu_s'] / other['cpu_s']:.1f}"


def main(folder):
    """Run the missing cases, and print the table; return whether a crush stopped."""
    folder.mkdir(parents=True, exist_ok=True)
    file, cases = folder / "wide.h5", {panel: pressed(panel) for panel in panels()}
    run_sweep(list(cases.values()), file)
    rows = read_summary(file).set_index("case_id")
    by_panel = {panel: rows.loc[case.case_id] for panel, case in cases.items()}
    publish([table(by_panel)], folder / "wide.md")
    return any(row["status"] != Status.CONVERGED for row in by_panel.values())


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
