"""Runs a sweep into its results file: skips finished cases, runs the others, folds the results."""

import os
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path
from threading import current_thread, main_thread

from sweep.config.case import Case
from sweep.config.cases import Cases, compact
from sweep.config.grid import Config, cases_of, sweep_of
from sweep.numbers import counted
from sweep.result import HOW_TO_RENEW, Result, Status
from sweep.running.batches import Kind, Plan, cost, kind
from sweep.running.case_notes import sentences_on_lossless, sentences_on_periods
from sweep.running.child_process import DIED, NO_MEMORY, Simulate, run_alone
from sweep.running.cluster import Cluster, Scheduler
from sweep.running.dask_graph import Work, run_on_cluster
from sweep.running.journal import Journal
from sweep.running.memory import limited_memory
from sweep.running.place import Place, open_place
from sweep.running.progress import Progress, announce
from sweep.running.provenance import config_text, describe_run
from sweep.running.threads import Sink, Stop, run_on_threads
from sweep.running.warming import real_simulate, simulate_unloaded
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

CROWDED = (NO_MEMORY, DIED)  # messages of cases that run again, one at a time
SUSPECTED = "ran when the last run died: now first, each in a process of its own"


class Interrupted(KeyboardInterrupt):
    """A sweep that was stopped; the text says which results are kept and how to continue."""


def run_sweep(  # noqa: PLR0913  what, where, how
    sweep: Config | Sequence[Case],
    out: str | os.PathLike[str],
    workers: int = 2,
    scheduler: Scheduler = None,
    rerun: Rerun = ONLY_MISSING,
    simulate: Simulate | None = None,
    part: bool = False,
) -> int:
    """Run the cases that `out` does not contain; return how many cases of the sweep are not
    converged.

    scheduler: as in `open_place`; `workers` are threads of this process, each with a child process
    in `Processes`. rerun: cases that run again; an old row stays until the new one is sealed.
    Ctrl-C (or SIGTERM) keeps finished cases and raises `Interrupted`. part: as in `Progress`.
    """
    config = sweep_of(sweep)
    config = replace(config, name=config.name or Path(out).stem)
    cases = compact(cases_of(config))
    stop = Stop()
    with ExitStack() as stack:
        place = stack.enter_context(open_place(scheduler))
        try:
            about = describe_run(config_text(config))
            about |= {"part": config.part} if config.part else {}
            writer = stack.enter_context(Writer(out, cases.labels, about))
        except WriteError as error:
            if cases.ids - finished_ids(out, rerun):
                raise
            announce(f"{error} All {len(cases)} cases are in it already.")
            return len(cases) - _converged(out, cases.ids)
        done = _intact(out, cases, rerun)
        to_run = cases.without(done)
        for line in (*sentences_on_lossless(to_run), *sentences_on_periods(to_run)):
            announce(line)
        work = _work(simulate, to_run, place) if to_run else None
        with interruptible(stop):
            if work:
                show = partial(
                    Progress, len(to_run), done=len(done), part=part, running=stop.shares
                )
                _run_missing(to_run, work, workers, place, writer, show, stop)
            else:
                with writer_thread() as thread:
                    thread.submit(writer.fold).result()
    kept = len(cases.ids & finished_ids(out, rerun))
    if stop.flag and kept < len(cases):
        line = f"interrupted; {out} keeps {kept} of {len(cases)} cases"
        raise Interrupted(f"{line}, and the same command runs the rest")
    return len(cases) - _converged(out, cases.ids)


def _intact(out: str | os.PathLike[str], cases: Cases, rerun: Rerun) -> set[str]:
    """The ids of the cases that need not run again; reports damaged rows and rows of an older
    model.
    """
    finished = cases.ids & finished_ids(out, rerun)
    changed = changed_cases(out, finished, cases.of)
    finished -= changed
    if lost := changed.union(damaged_ids(out)):
        announce(f"damaged rows in {out}: {len(lost)}; cases of this sweep run again")
    if old := finished & older_ids(out):
        announce(
            f"{len(old)} of {len(finished)} finished cases are of an older model; {HOW_TO_RENEW}"
        )
    return finished


def _run_missing(  # noqa: PLR0913  what, where, how
    cases: Cases,
    work: Work,
    workers: int,
    place: Place,
    writer: Writer,
    show: Callable[[Mapping[Kind, float]], Progress],
    stop: Stop,
) -> None:
    """Run cases, the suspects of a run that died first, and pass their results to the writer."""
    with Journal(writer.path) as journal:
        suspects = [cases.of(i) for i in journal.suspects if i in cases.ids]
        for case_id in {*journal.suspects} - cases.ids:
            journal.end(case_id)
        if suspects:
            announce(f"{counted(len(suspects), 'case')} {SUSPECTED}")
        plan = Plan(cases.without(journal.suspects), workers)
        for case in suspects:
            plan.work[kind(case)] += cost(case)
        with show(plan.work) as progress, result_sink(writer, plan, progress) as sink:
            keep = _ending(suspects, journal, sink)
            if isinstance(place, Cluster):
                run_on_cluster(plan, work, keep, stop, place, progress.say, suspects)
                return
            _run_alone(work.simulate, suspects, keep, stop)
            again: list[Case] = []
            first = partial(_sort_out, again, sink)
            in_place = place.runs(work.simulate) if place else work.simulate
            with nullcontext() if place else limited_memory():
                run_on_threads(plan, journal.watched(in_place), first, stop, progress.tick)
            _run_alone(work.simulate, again, sink, stop)


def _work(simulate: Simulate | None, cases: Sequence[Case], place: Place) -> Work:
    """The function that runs the cases; the kernels that they need are loaded only where they
    run.
    """
    if simulate is not None:
        return Work(simulate, [])
    if isinstance(place, Cluster):
        return Work(*simulate_unloaded(cases))
    return Work(real_simulate(cases), [])


def _run_alone(simulate: Simulate, cases: Iterable[Case], sink: Sink, stop: Stop) -> None:
    """Run cases one after the other, each in a process of its own."""
    for case in cases:
        sink(run_alone(simulate, [case], lambda: stop.flag))


def _sort_out(again: list[Case], sink: Sink, results: list[Result]) -> None:
    """Pass on results, except of cases that may have lacked memory beside others, which go to
    ``again``.
    """
    again += [result.case for result in results if result.message in CROWDED]
    if ended := [result for result in results if result.message not in CROWDED]:
        sink(ended)


def _ending(suspects: Iterable[Case], journal: Journal, sink: Sink) -> Sink:
    """A sink that also records in the journal which suspects have ended."""
    ids = {case.case_id for case in suspects}

    def keep(results: list[Result]) -> None:
        sink(results)
        for case_id in ids & {result.case_id for result in results}:
            journal.end(case_id)

    return keep


def _converged(out: str | os.PathLike[str], cases: Iterable[str]) -> int:
    """How many of these cases, by id, have converged."""
    statuses = read_statuses(out)
    return sum(statuses.get(case_id) == Status.CONVERGED for case_id in cases)


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
