"""Runs a config from Python and returns its results; repeats its best designs at the ends of the
ranges of uncertain numbers.
"""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from pandas import DataFrame

from sweep.config.case import Case
from sweep.config.cases import compact
from sweep.config.grid import Config
from sweep.config.load import Source, load_config
from sweep.ranking.curves import with_allowed
from sweep.ranking.merit import check_panel
from sweep.ranking.question import Question
from sweep.ranking.rank import answer
from sweep.ranking.ranking import Ranking
from sweep.ranking.spread import Spread, spread_table, spreads
from sweep.results import Results
from sweep.running.applicable import check_required
from sweep.running.beside.error_bars import add_error_bars
from sweep.running.beside.run_beside import How, file_beside
from sweep.running.beside.spread import BEST, Corners, corners_of, run_corners
from sweep.running.cluster import Scheduler
from sweep.running.place import chosen_place, open_place
from sweep.running.progress import announce
from sweep.running.sweep import run_sweep
from sweep.store.read import ONLY_MISSING, Rerun, read_summary


def run(
    config: Config | Source,
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    rerun: Rerun = ONLY_MISSING,
    scheduler: Scheduler = None,
    error_bars: bool = False,
) -> Results:
    """Run the cases of a config that its results file does not hold; return the results of all.

    config: a dict of tables, the path of a TOML file, the name of an example, or a `Config`. out:
    the results file, by default results/NAME.h5. workers: threads. scheduler: in place of threads,
    "processes" of this machine, as many as workers; or a `distributed.Client` or one of Dask's
    clusters, the address or the file of a scheduler, or "slurm". By default the scheduler of
    DASK_SCHEDULER_ADDRESS, if it is set; else one thread per core, or beyond 8 cores one process
    per core. error_bars: also run each design on a coarser mesh and with longer steps, for the
    columns `error_...`. Progress is shown, in a notebook as one line.
    """
    config = config if isinstance(config, Config) else load_config(config)
    check_question(config)
    for line in config.notes:
        announce(line)
    path = Path(out or f"results/{config.name}.h5")
    count, where = chosen_place(workers, scheduler)
    with open_place(where) as place:
        how = How(count, place, rerun)
        run_sweep(config, path, *how)
        if error_bars:
            add_error_bars(config, path, how)
    ids = [*compact(config.cases).ids]
    question = {
        "budget": list(config.rank.budgets) or None,
        "panel": config.rank.panel,
        "require": config.require.model_dump(),
        "per": config.rank.per,
    }
    return Results(path, ids, question)


def spread(
    results: Results | str | os.PathLike[str],
    top: int = BEST,
    workers: int | None = None,
    scheduler: Scheduler = None,
) -> DataFrame:
    """Run the best designs again with each uncertain number at both ends of its range.

    results: from `run` or `optimize`, with their question, or a results file. top: number of
    designs of each ranking. The cases are kept beside the results, in NAME.spread.h5. Returns the
    table of `sweep.ranking.spread.spread_table`, a row per design.
    """
    results = results if isinstance(results, Results) else Results(results)
    count, where = chosen_place(workers, scheduler)
    with open_place(where) as place:
        how = How(count, place)
        question = results.question._replace(top=top)
        spreads = spreads_of([], results.table, question, results.path, how)
    return spread_table(spreads)


def spreads_of(
    cases: Sequence[Case],
    summary: DataFrame,
    question: Question,
    out: str | os.PathLike[str],
    how: How,
) -> list[Spread]:
    """The spreads of the best designs of a question: none if no number is uncertain.

    cases: see `corners_of`. summary: of the results in `out`.
    """
    ranking = answer(with_allowed(out, summary, question), question)
    corners = corners_of(cases, ranking.table["case_id"], out)
    return spreads_among(corners, ranking, question, out, how) if any(corners.values()) else []


def spreads_among(
    corners: Mapping[str, Corners],
    ranking: Ranking,
    question: Question,
    out: str | os.PathLike[str],
    how: How,
) -> list[Spread]:
    """Run the corners of designs that are ranked, by the ids of these, and return the spreads."""
    run_corners(corners, out, how)
    beside = file_beside(out, "spread")
    rows = with_allowed(beside, read_summary(beside), question)
    ids = {
        design: [(name, case.case_id) for name, case in group.items()]
        for design, group in corners.items()
    }
    return spreads(ranking, rows, ids, question)


def check_question(config: Config) -> None:
    """Refuse, before cases run, a requirement that applies to no case of a config, or a panel
    smaller than half a specimen.
    """
    if config.rank.panel:
        check_panel(config.rank.panel, config.cases)
    if any(limit is not None for _, limit in config.require):
        check_required(dict(config.require), config.cases)
