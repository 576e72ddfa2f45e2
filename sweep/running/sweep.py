"""Runs a sweep into its results file: skip finished cases, run the others, fold."""

import os
import signal
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from threading import current_thread, main_thread

from sweep.config.case import Case
from sweep.config.grid import Config, expand, sweep_of
from sweep.numbers import counted
from sweep.result import HOW_TO_RENEW, Status
from sweep.running.alone import Simulate, run_alone
from sweep.running.batches import Plan, cost
from sweep.running.dask_graph import Stop, check_scheduler, run_plan
from sweep.running.journal import Journal
from sweep.running.period_note import sentences_on_periods
from sweep.running.progress import Progress, announce
from sweep.running.provenance import config_text, describe_run
from sweep.running.relaxation_warning import sentences_on_lossless
from sweep.running.writer_thread import result_sink, writer_thread
from sweep.store.read import (
    ONLY_MISSING,
    Rerun,
    changed_cases,
    damaged_ids,
    finished_ids,
    older_ids,
    read_statuses,
)
from sweep.store.write import WriteError, Writer

SUSPECTED = "ran when the last run died: now first, each in a process of its own"
UNWRITABLE = "CRUMPLE_CACHE_DIR, else crumple in ~/.cache, is not a writable folder"


class Interrupted(KeyboardInterrupt):
    """A sweep that was stopped; the text says what is kept and how to continue."""


def run_sweep(  # noqa: PLR0913  what, where, how
    sweep: Config | Sequence[Case],
    out: str | os.PathLike[str],
    workers: int = 2,
    scheduler: str | None = None,
    rerun: Rerun = ONLY_MISSING,
    simulate: Simulate | None = None,
    part: bool = False,
) -> int:
    """Run the cases that `out` does not hold; return how many cases of the sweep are not converged.

    scheduler: address of a Dask scheduler; without one, `workers` threads of this process.
    rerun: cases that run again; an old row stays until the new one is sealed. Ctrl-C (or SIGTERM)
    keeps finished cases and raises `Interrupted`. part: as of `Progress`.
    """
    config = sweep_of(sweep)
    cases = {case.case_id: case for case in expand(config)}
    axes = {case_id: case.axes for case_id, case in cases.items()}
    stop = Stop()
    if scheduler is not None:
        check_scheduler(scheduler)
    with ExitStack() as stack:
        try:
            about = describe_run(config_text(config))
            writer = stack.enter_context(Writer(out, axes, about))
        except WriteError as error:
            if cases.keys() - finished_ids(out, rerun):
                raise
            announce(f"{error} All {len(cases)} cases are in it already.")
            return len(cases) - _converged(out, cases)
        done = cases.keys() & finished_ids(out, rerun)
        changed = changed_cases(out, {case_id: cases[case_id] for case_id in done})
        done -= changed
        if lost := changed.union(damaged_ids(out)):
            announce(f"damaged rows in {out}: {len(lost)}; cases of this sweep run again")
        if old := done & older_ids(out):
            announce(
                f"{len(old)} of {len(done)} finished cases are of an older model; {HOW_TO_RENEW}"
            )
        waiting = {case_id: case for case_id, case in cases.items() if case_id not in done}
        asked = list(waiting.values())
        for line in (*sentences_on_lossless(asked), *sentences_on_periods(asked)):
            announce(line)
        chosen = simulate or real_simulate(waiting.values()) if waiting else None
        with interruptible(stop):
            if not chosen:
                with writer_thread() as thread:
                    thread.submit(writer.fold).result()
            else:
                journal = stack.enter_context(Journal(writer.path))
                suspects = [waiting.pop(i) for i in journal.suspects if i in waiting]
                for case_id in {*journal.suspects} - {case.case_id for case in suspects}:
                    journal.end(case_id)
                if suspects:
                    announce(f"{counted(len(suspects), 'case')} {SUSPECTED}")
                plan = Plan(waiting.values(), workers)
                costs = {case.case_id: cost(case) for case in asked}
                with (
                    Progress(costs, len(done), part=part) as progress,
                    result_sink(writer, plan, progress) as sink,
                ):
                    for case in suspects:
                        if result := run_alone(chosen, case, lambda: stop.flag):
                            sink([result])
                            journal.end(case.case_id)
                    watched = journal.watched(chosen) if scheduler is None else chosen
                    run_plan(plan, watched, sink, stop, scheduler)
    kept = len(cases.keys() & finished_ids(out, rerun))
    if stop.flag and kept < len(cases):
        line = f"interrupted; {out} keeps {kept} of {len(cases)} cases"
        raise Interrupted(f"{line}, and the same command runs the rest")
    return len(cases) - _converged(out, cases)


def _converged(out: str | os.PathLike[str], cases: Iterable[str]) -> int:
    """How many of these cases, by id, have converged."""
    statuses = read_statuses(out)
    return sum(statuses.get(case_id) == Status.CONVERGED for case_id in cases)


def real_simulate(cases: Iterable[Case]) -> Simulate:
    """The function `simulate_again`, with the kernels that these cases need.

    It is imported only here, since it loads or compiles the kernels.
    """
    from kernels.compile.cache import is_lasting
    from kernels.compile.choice import FAST, compiler
    from sweep.simulation.retries import simulate_again
    from sweep.simulation.simulate import kernels_of

    kernels = sorted({kernels_of(case) for case in cases})
    if cold_kernels(kernels):
        takes = "a minute or two" if compiler() == FAST else "two or three minutes"
        announce(f"compiling the kernels, once: this takes {takes}")
        if not is_lasting():
            announce(f"for this run alone: {UNWRITABLE}")
    load(kernels)
    return simulate_again


def cold_kernels(kernels: Iterable[str]) -> list[str]:
    """Those of the named kernels (keys of `SMALLEST`) that may have to be compiled."""
    from kernels.compile.cache import is_cold

    return [name for name in kernels if is_cold(name)]


def load(kernels: Iterable[str]) -> None:
    """Load or compile the named kernels, and note that they are kept."""
    from kernels.compile.cache import warmed_up
    from sweep.simulation.simulate import warm_up

    for name in kernels:
        warm_up([name])
        warmed_up(name)


@contextmanager
def interruptible(stop: Stop) -> Iterator[None]:
    """Turn the first Ctrl-C or SIGTERM into `stop.ask`; the next one has its usual effect."""
    if current_thread() is not main_thread():
        yield  # only the main thread can handle signals
        return
    usual = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def restore() -> None:
        for number, handler in usual.items():
            signal.signal(number, handler)

    def ask(*_: object) -> None:
        restore()
        stop.ask()

    for number in usual:
        signal.signal(number, ask)
    try:
        yield
    finally:
        restore()
