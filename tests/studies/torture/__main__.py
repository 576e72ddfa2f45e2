"""Run by `make torture`: damaged files, mutated inputs, poisoned cases, killed commands,
workers and schedulers.

It fails if anything is silently wrong, and keeps the inputs that it fails on. It also measures how
long cases hold Python's lock.

python -m tests.studies.torture FOLDER [SHARE of the numbers below]
"""

import shutil
import sys
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory

from sweep.config.load import load_config
from sweep.running.sweep import run_sweep
from tests.studies.tables import publish
from tests.studies.torture import clusters, damage, fuzz, kills, lock, poison

DAMAGES = 150  # of each kind
KILLS = 20  # of each command
INPUTS = 3000
WORKERS, SCHEDULERS, CASES = 30, 2, 2000  # killed, killed, of each run
POISONED = 400  # cases of each sweep with poisoned ones


def main(folder: Path, share: float = 1.0) -> int:
    """Print the tables, which go to the folder too."""
    folder.mkdir(parents=True, exist_ok=True)
    results, number = folder / "smoke.h5", count(1)
    run_sweep(load_config("smoke"), results)

    def keep(what: str, path: Path) -> None:
        shutil.copy(path, folder / f"{next(number)} {what} {path.name}")

    counts = damage.damage(results, int(share * DAMAGES))
    with TemporaryDirectory() as place:
        counts |= damage.damage_part(results, Path(place), int(share * DAMAGES))
    with TemporaryDirectory() as place:
        inputs = fuzz.fuzz(Path(place), results, int(share * INPUTS), keep)
    killed = {}
    for verb in kills.VERBS:
        with TemporaryDirectory() as place:
            killed[verb] = kills.torture(Path(place), verb, int(share * KILLS))
    with TemporaryDirectory() as place:
        cluster = clusters.torture(Path(place), int(share * WORKERS), SCHEDULERS, CASES)
    poisoned = {}
    for where in poison.PLACES:
        with TemporaryDirectory() as place:
            poisoned[where] = poison.torture(Path(place), where, POISONED)
    locks = {name: lock.held(name, some) for name, some in lock.CONFIGS.items()}
    sheets = [
        damage.sheet(counts), fuzz.sheet(inputs), kills.sheet(killed), clusters.sheet(cluster),
        poison.sheet(poisoned), lock.sheet(locks),
    ]  # fmt: skip
    publish(sheets, folder / "torture.md")
    nothing_lost = cluster.lost == cluster.wrong == 0 < cluster.refused
    nothing_lost &= all(found.lost == found.twice == 0 for found in killed.values())
    nothing_lost &= poison.is_sound(poisoned)
    return 0 if damage.is_sound(counts) and fuzz.is_sound(inputs) and nothing_lost else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *map(float, sys.argv[2:])))
