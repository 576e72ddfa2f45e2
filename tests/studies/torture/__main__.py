"""Run by `make torture`: damaged files, killed runs, workers and schedulers.

It fails if anything is silently wrong.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from sweep.config.load import load_config
from sweep.running.sweep import run_sweep
from tests.studies.tables import publish
from tests.studies.torture import clusters, damage, kills

DAMAGES = 150  # of each kind
KILLS = 100
WORKERS, SCHEDULERS, CASES = 30, 2, 2000  # killed, killed, of each run


def main(folder: Path) -> int:
    """Print the tables, which go to the folder too."""
    folder.mkdir(parents=True, exist_ok=True)
    run_sweep(load_config("smoke"), folder / "smoke.h5")
    counts, killed = damage.damage(folder / "smoke.h5", DAMAGES), kills.torture(folder, KILLS)
    with TemporaryDirectory() as place:
        cluster = clusters.torture(Path(place), WORKERS, SCHEDULERS, CASES)
    sheets = [damage.sheet(counts), kills.sheet(killed), clusters.sheet(cluster)]
    publish(sheets, folder / "torture.md")
    nothing_lost = killed.lost == killed.twice == cluster.lost == cluster.wrong == 0
    return 0 if damage.is_sound(counts) and nothing_lost else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
