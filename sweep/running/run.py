"""Runs a config from Python and returns its results."""

import os
from pathlib import Path

from sweep.config.grid import Config
from sweep.config.load import load_config
from sweep.ranking.merit import check_panel
from sweep.report.results import Results
from sweep.running.applicable import check_required
from sweep.running.cluster import Scheduler, usual_scheduler
from sweep.running.sweep import run_sweep
from sweep.running.threads import usual_workers
from sweep.store.read import ONLY_MISSING, Rerun


def run(
    config: Config | str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    rerun: Rerun = ONLY_MISSING,
    scheduler: Scheduler = None,
) -> Results:
    """Run the cases of a config that its results file does not hold; return the results of all.

    config : from `load_config`, or the path of a TOML file, or the name of an example. out : the
    results file, by default results/NAME.h5. workers: threads, by default one per core up to 8.
    scheduler: in place of threads, a `distributed.Client` or one of Dask's clusters, the address or
    the file of a scheduler, or "slurm"; by default that of DASK_SCHEDULER_ADDRESS, if it is set
    and `workers` is not given. Progress is shown, in a notebook as one line.
    """
    config = config if isinstance(config, Config) else load_config(config)
    check_question(config)
    path = Path(out or f"results/{config.name}.h5")
    if scheduler is None and workers is None:
        scheduler = usual_scheduler()
    run_sweep(config, path, workers or usual_workers(), scheduler, rerun)
    ids = [case.case_id for case in config.cases]
    question = {
        "budget": list(config.rank.budgets) or None,
        "panel": config.rank.panel,
        "require": config.require.model_dump(),
        "per": config.rank.per,
    }
    return Results(path, ids, question)


def check_question(config: Config) -> None:
    """Refuse what no case of a config can be asked for, before cases run: a requirement, or a panel
    that is smaller than half a specimen.
    """
    if config.rank.panel:
        check_panel(config.rank.panel, config.cases)
    if required := [name for name, limit in config.require if limit is not None]:
        check_required(required, config.cases)
