"""Cases on threads: every case once, whatever its neighbours do."""

import sys
import threading
import time

import pytest

from sweep.result import Status
from sweep.running.batches import Plan
from sweep.running.threads import Stop, run_on_threads
from tests.support.results.standin import Kept, cases, number_of, simulate


def ran(batch, simulate, stop=None, workers=2):
    kept = Kept()
    run_on_threads(Plan(batch, workers), simulate, kept, stop or Stop())
    return kept


def test_every_case_runs_once():
    batch = cases(300)
    seen = []
    kept = ran(batch, lambda case, stop: seen.append(case.case_id) or simulate(case))
    assert sorted(seen) == sorted(case.case_id for case in batch)
    assert kept.results.keys() == {case.case_id for case in batch}
    assert len(kept) < 100


def test_batches_are_handed_over_one_at_a_time_while_others_run():
    busy, clashes, threads = threading.Lock(), [], set()

    def sink(results):
        threads.add(threading.get_ident())
        clashes.append(not busy.acquire(blocking=False))
        time.sleep(0.002)
        busy.release()

    run_on_threads(
        Plan(cases(100), 2), lambda case, stop: time.sleep(0.001) or simulate(case), sink, Stop()
    )
    assert len(clashes) > 1
    assert not any(clashes)


def test_a_long_case_tells_how_far_it_is(monkeypatch):
    monkeypatch.setattr("sweep.running.threads.LONG", 0.01)
    stop, seen = Stop(), []

    def works(case, control):
        control[1:] = 1, 4
        time.sleep(0.5)
        return simulate(case)

    plan = Plan(cases(1), 1)
    run_on_threads(plan, works, Kept(), stop, tick=lambda: seen.append(stop.shares()))
    assert seen[0] == [0.25]
    assert stop.shares() == []


def test_the_main_thread_never_waits_without_a_limit(monkeypatch):
    """On Windows it would hear no Ctrl-C (https://github.com/python/cpython/issues/74157)."""
    limits, usual = [], threading.Event.wait

    def waits(event, timeout=None):
        starts = sys._getframe(1).f_code.co_name == "start"  # of a thread: a moment
        if threading.current_thread() is threading.main_thread() and not starts:
            limits.append(timeout)
        return usual(event, timeout)

    monkeypatch.setattr(threading.Event, "wait", waits)
    ran(cases(2), lambda case, stop: time.sleep(0.3) or simulate(case))
    assert len(limits) > 1
    assert None not in limits


def test_error_of_the_sink_ends_the_sweep():
    def full(results):
        raise OSError("no space left")

    started = time.perf_counter()
    slow = lambda case, stop: time.sleep(0.05) or simulate(case)  # noqa: E731
    with pytest.raises(OSError, match="no space"):
        run_on_threads(Plan(cases(200), 2), slow, full, Stop())
    assert time.perf_counter() - started < 2


def test_stop_reaches_running_cases_and_forgets_them():
    """Two cases run at a time; cases that the stop cuts short are not results."""
    stop, running = Stop(), threading.Semaphore(0)

    def endless(case, control):
        if number_of(case) < 2:
            return simulate(case)
        running.release()
        while not control[0]:
            time.sleep(0.001)
        return simulate(cases(8)[7])  # a result with the status `stopped`

    def ask():
        assert running.acquire(timeout=5)
        assert running.acquire(timeout=5)
        stop.ask()

    threading.Thread(target=ask).start()
    batch = cases(6)
    kept = ran(batch, endless, stop)
    assert kept.results.keys() <= {case.case_id for case in batch[:2]}


def test_each_case_has_its_own_control():
    """One that reaches its time limit, and uses its own array to end, must not end the others."""
    together = threading.Barrier(2, timeout=5)
    seen = []

    def expire(case, control):
        together.wait()
        control[0] = 1
        together.wait()
        seen.append(control)
        return simulate(case)

    kept = ran(cases(2), expire)
    assert seen[0] is not seen[1]
    assert len(kept.results) == 2


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (ZeroDivisionError("of\nsomething"), "ZeroDivisionError: of something"),
        (MemoryError(), "needs more memory than there is; try fewer cells, nodes or steps"),
    ],
)
def test_exception_in_a_case_is_a_row(error, told):
    def broken(case, stop):
        if number_of(case) == 2:
            raise error
        return simulate(case)

    batch = cases(5)
    failed = ran(batch, broken).results[batch[2].case_id]
    assert failed.status is Status.STOPPED
    assert told in failed.message
