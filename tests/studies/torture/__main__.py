"""Run by `make torture`: damaged files, killed runs. It fails if anything is silently wrong."""

import sys
from pathlib import Path

from sweep.config.load import load_config
from sweep.running.sweep import run_sweep
from tests.studies.tables import publish
from tests.studies.torture import damage, kills

DAMAGES = 150  # of each kind
KILLS = 100


def main(folder: Path) -> int:
    """Print the tables, which go to the folder too."""
    folder.mkdir(parents=True, exist_ok=True)
    run_sweep(load_config("smoke"), folder / "smoke.h5")
    counts, killed = damage.damage(folder / "smoke.h5", DAMAGES), kills.torture(folder, KILLS)
    publish([damage.sheet(counts), kills.sheet(killed)], folder / "torture.md")
    return 0 if damage.is_sound(counts) and killed.lost == killed.twice == 0 else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
