"""Run by `make scale`: time and memory of every verb for 20,000 and 100,000 invented cases.

python -m tests.studies.scale FOLDER [COUNT ...]
"""

import sys
from pathlib import Path

from sweep.report.tables.sheet import Sheet
from tests.studies.scale.invented import write_config
from tests.studies.scale.measure import ACTIONS, measured
from tests.studies.tables import publish

COUNTS = (20_000, 100_000)
PAGE, FILE = "the page, MB", "the results file, MB"


def sheet(folder, count):
    """The table of one number of cases."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scale.h5").unlink(missing_ok=True)
    write_config(folder, count)
    rows = []
    for action in ACTIONS:
        told = measured(folder, action)
        rows.append([action, *(f"{told[name]:.3g}" for name in ("cpu_s", "wall_s", "peak_MB"))])
    for what, name in ((PAGE, "scale.html"), (FILE, "scale.h5")):
        rows.append([what, "", "", f"{(folder / name).stat().st_size / 1e6:.3g}"])
    return Sheet(f"{count:,} cases", ["", "CPU s", "s", "MB"], rows)


def main(folder, counts):
    """Print the tables, which go to the folder too."""
    publish([sheet(folder / str(count), count) for count in counts], folder / "scale.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]), [int(count) for count in sys.argv[2:]] or COUNTS)
