"""The verb `run`: simulates the missing cases, with error bars, a first screen or a spread; ranks
them.
"""

from argparse import Namespace
from dataclasses import replace

from pandas import DataFrame

from sweep.cli.place import place_of, requested_place
from sweep.cli.question import question_of
from sweep.cli.refusals import ArgumentError
from sweep.cli.terminal import hint, next_commands, print_ranking, print_sheets, say, say_all
from sweep.config.grid import Config, cases_of
from sweep.ranking.question import Question
from sweep.report.tables.screen_sheets import screen_sheets
from sweep.report.tables.spread_sheets import spread_sheets
from sweep.running.beside.error_bars import add_error_bars
from sweep.running.beside.run_beside import How, file_beside
from sweep.running.beside.screen import best_of, has_column, run_columns
from sweep.running.beside.spread import BEST
from sweep.running.estimate import dry_run
from sweep.running.run import check_question, spreads_of
from sweep.running.sweep import run_sweep
from sweep.store.read import Rerun, read_summary

SCREENED = "--screen runs one cell of each design first, and only the best of each infill in full"
NO_COLUMNS = (
    "--screen estimates crushes along equal cells without an outline by one cell each, and no case "
    'of this config is one; allowed: cases with loading.direction = "out_of_plane"'
)
MERGED = "when all {0} parts are done: crumple merge OUT.h5 and the {0} results files"
BESIDE = ("error_bars", "spread", "screen")
UNKNOWN_BEST = "--spread runs more cases, of designs that are known only after the sweep"


def run(config: Config, arguments: Namespace) -> int:
    """Simulate the missing cases, then rank; with --dry-run, only estimate. Return how many failed.

    With --error-bars, a design without an error bar counts as a failure.
    """
    check_question(config)
    name, part = config.name, arguments.part
    if part:
        config, name = _part(config, arguments), f"{name}.{part[0]}-of-{part[1]}"
    out = arguments.out or f"results/{name}.h5"
    renew = arguments.renew
    rerun = Rerun(failed=arguments.retry_failed, older=renew, damaged=renew)
    if arguments.dry_run:
        workers, _ = requested_place(arguments)
        say(dry_run(config, out, workers, rerun, arguments.error_bars))
        say_all([UNKNOWN_BEST] if arguments.spread else [])
        say_all([SCREENED] if arguments.screen else [])
        return 0
    with place_of(arguments) as place:
        return _simulate(config, arguments, out, How(*place, rerun))


def _simulate(config: Config, arguments: Namespace, out: str, how: How) -> int:
    """Simulate the missing cases, then rank; return how many failed."""
    part = arguments.part
    question = question_of(config.rank.budgets, config.rank.panel)
    question = question._replace(require=config.require.model_dump(), per=config.rank.per)
    failed, estimates = 0, None
    if arguments.screen:
        config, estimates, failed = _screen(config, out, how, question, arguments.screen)
    failed += run_sweep(config, out, *how)
    failed += add_error_bars(config, out, how) if arguments.error_bars else 0
    ranking = print_ranking(out, read_summary(out), question, arguments.brief)
    if estimates is not None:
        print_sheets(screen_sheets(estimates, read_summary(out), question))
    failed += _spread(config, out, how, question) if arguments.spread else 0
    hint([MERGED.format(part[1])] if part else next_commands(out, ranking))
    return failed


def _part(config: Config, arguments: Namespace) -> Config:
    """Every Nth case of a sweep, starting with the Kth, so that the parts take about as long."""
    number, count = arguments.part
    if beside := [name for name in BESIDE if getattr(arguments, name)]:
        option = beside[0].replace("_", "-")
        raise ArgumentError(
            f"--{option} is of a whole sweep: run it on the merged file, without --part"
        )
    cases = cases_of(config)[number - 1 :: count]
    if not cases:
        raise ArgumentError(
            f"--part {number}/{count}: the sweep has only {len(config.cases)} cases"
        )
    return replace(config, cases=cases, part=f"{number}/{count}")


def _screen(
    config: Config, out: str, how: How, question: Question, count: int
) -> tuple[Config, DataFrame, int]:
    """Run the unit columns of a sweep; return the config of the designs to simulate in full, the
    estimates, and how many designs have none.
    """
    beside = file_beside(out, "screen")
    screened = [case for case in config.cases if has_column(case)]
    if not screened:
        raise ArgumentError(NO_COLUMNS)
    estimates, why = run_columns(screened, out, how), f"crumple status {beside} says why"
    missing = len(screened) - len(estimates)
    if missing:
        say(f"{missing} designs have no estimate: {why}")
    if estimates.empty:
        raise ArgumentError(f"no unit column converged: {why}")
    best = best_of(estimates, question, count)
    left_out = {case.case_id for case in screened} - {*best}
    kept = tuple(case for case in config.cases if case.case_id not in left_out)
    return replace(config, cases=kept), estimates, missing


def _spread(config: Config, out: str, how: How, question: Question) -> int:
    """Run the best designs with uncertain numbers and print their spread; return how many values
    are missing.
    """
    summary = read_summary(out)
    results = spreads_of(config.cases, summary, question._replace(top=BEST), out, how)
    if not results:
        say("No number of the best designs is uncertain.")
        return 0
    print_sheets(spread_sheets(results, summary))
    return sum(spread.failed for spread in results)
