"""How fast narrow specimens approach a wide panel, with free sides and with tied ones.

Run by `make sides`: all infills, in cells of the same size and walls of the same thickness, between
glued platens and loose ones with and without friction, crushed to 50 %. Two wide specimens with
free sides have the same edges: the excess of the wider one, energy / mass, is the middle of a
panel, with which all others are compared. Finished cases are kept in the given folder.
"""

import sys
from pathlib import Path

from sweep.running.sweep import run_sweep
from sweep.store.read import read_summary
from tests.studies.sides.panels import crush, strips
from tests.studies.sides.table import table
from tests.studies.tables import publish


def main(folder):
    """Run the missing cases, and print the table."""
    folder.mkdir(parents=True, exist_ok=True)
    file, cases = folder / "sides.h5", {strip: crush(strip) for strip in strips()}
    run_sweep(list(cases.values()), file)
    rows = read_summary(file).set_index("case_id")
    publish(
        [table({strip: rows.loc[case.case_id] for strip, case in cases.items()})],
        folder / "sides.md",
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
