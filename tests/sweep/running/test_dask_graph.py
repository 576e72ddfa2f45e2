"""Cases on Dask: every case once, whatever its neighbours do."""

import os
import socket
import threading
import time

import pytest

from sweep.result import Status
from sweep.running.batches import Plan
from sweep.running.dask_graph import GraphError, Stop, check_scheduler, run_plan, usual_workers
from tests.support.results.standin import cases, number_of, simulate


class Kept(list):
    """A sink that remembers the batches."""

    def __call__(self, results):
        """Remember a batch."""
        self.append(results)

    @property
    def results(self):
        """All results by their case."""
        return {result.case_id: result for batch in self for result in batch}


def run_on_threads(batch, simulate, stop=None, workers=2):
    kept = Kept()
    run_plan(Plan(batch, workers), simulate, kept, stop or Stop())
    return kept


def test_every_case_runs_once():
    batch = cases(300)
    seen = []
    kept = run_on_threads(batch, lambda case, stop: seen.append(case.case_id) or simulate(case))
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

    run_plan(
        Plan(cases(100), 2), lambda case, stop: time.sleep(0.001) or simulate(case), sink, Stop()
    )
    assert len(clashes) > 1
    assert not any(clashes)


def test_cases_run_at_the_same_time():
    together = threading.Barrier(2, timeout=5)
    kept = run_on_threads(cases(2), lambda case, stop: together.wait() * 0 or simulate(case))
    assert len(kept.results) == 2


def test_exception_in_a_case_is_a_row_with_its_name():
    def broken(case, stop):
        if number_of(case) == 2:
            raise ZeroDivisionError("of\nsomething")
        return simulate(case)

    batch = cases(5)
    failed = run_on_threads(batch, broken).results[batch[2].case_id]
    assert failed.status is Status.STOPPED
    assert "ZeroDivisionError: of something" in failed.message


def test_case_that_needs_too_much_memory_is_a_row_with_advice():
    def huge(case, stop):
        raise MemoryError

    failed = run_on_threads(cases(1), huge).results[cases(1)[0].case_id]
    assert failed.status is Status.STOPPED
    assert failed.message == "needs more memory than there is; try fewer cells, nodes or steps"


def test_error_of_the_sink_ends_the_sweep():
    def full(results):
        raise OSError("no space left")

    started = time.perf_counter()
    with pytest.raises(OSError, match="no space"):
        run_plan(
            Plan(cases(200), 2), lambda case, stop: time.sleep(0.05) or simulate(case), full, Stop()
        )
    assert time.perf_counter() - started < 2


def test_stop_reaches_running_cases_and_forgets_them():
    """Two cases run at a time; those that the stop cuts short are not results."""
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
    kept = run_on_threads(batch, endless, stop)
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

    kept = run_on_threads(cases(2), expire)
    assert seen[0] is not seen[1]
    assert len(kept.results) == 2


def poisonous(case, stop=None):
    """Case 11 takes its process with it; the others take a moment."""
    if number_of(case) == 11:
        os._exit(1)
    time.sleep(0.02)
    return simulate(case)


@pytest.mark.filterwarnings("ignore")  # of a worker that died, as it shall
def test_case_that_kills_its_worker_is_a_row_and_its_neighbours_succeed():
    from distributed import LocalCluster

    batch, kept = cases(24), Kept()
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with LocalCluster(**options, silence_logs=50) as cluster:
        run_plan(Plan(batch, 2), poisonous, kept, Stop(), cluster.scheduler_address)
        assert cluster.scheduler.allowed_failures == 3
    statuses = {number_of(case): kept.results[case.case_id].status for case in batch}
    assert statuses.pop(11) is Status.WORKER_DIED
    assert statuses.pop(7) is Status.STOPPED
    assert set(statuses.values()) == {Status.CONVERGED}
    assert sum(map(len, kept)) == 24


@pytest.mark.filterwarnings("ignore")
def test_stop_on_a_cluster_keeps_what_has_landed():
    from distributed import LocalCluster

    batch, kept, stop = cases(40), Kept(), Stop()

    def sink(results):
        kept(results)
        stop.ask()

    options = {"n_workers": 1, "threads_per_worker": 1, "processes": False}
    with LocalCluster(**options, dashboard_address=None, silence_logs=50) as cluster:
        run_plan(Plan(batch, 2), simulate, sink, stop, cluster.scheduler_address)
    assert 0 < sum(map(len, kept)) < 40


@pytest.mark.parametrize("address", ["nonsense", "", "tcp://", "host:port", "http://host:80"])
def test_what_is_no_address_is_refused_in_one_line(address):
    with pytest.raises(GraphError, match="such as tcp://host:8786") as refusal:
        check_scheduler(address)
    assert str(refusal.value).startswith(f'"{address}" is no address')
    assert "\n" not in str(refusal.value)


def test_scheduler_that_is_not_there(monkeypatch):
    monkeypatch.setattr("sweep.running.dask_graph.ANSWER", 0.5)
    with pytest.raises(GraphError, match="no Dask scheduler answers at tcp://"):
        check_scheduler("tcp://127.0.0.1:9")


def test_server_that_never_answers(monkeypatch):
    monkeypatch.setattr("sweep.running.dask_graph.ANSWER", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = "tcp://{}:{}".format(*server.getsockname())
        with pytest.raises(GraphError, match=f"no Dask scheduler answers at {address}"):
            check_scheduler(address)


@pytest.mark.filterwarnings("ignore")
def test_scheduler_that_goes_away_is_told_in_one_line(monkeypatch):
    from distributed import LocalCluster

    monkeypatch.setattr("sweep.running.dask_graph.ANSWER", 1)
    options = {"n_workers": 1, "threads_per_worker": 1, "processes": False}
    with (
        LocalCluster(**options, dashboard_address=None, silence_logs=60) as cluster,
        pytest.raises(GraphError, match="lost the Dask scheduler at inproc"),
    ):
        run_plan(
            Plan(cases(40), 2),
            simulate,
            lambda _: cluster.close(),
            Stop(),
            cluster.scheduler_address,
        )


@pytest.mark.filterwarnings("ignore")
def test_worker_is_no_scheduler():
    from distributed import LocalCluster

    options = {"n_workers": 1, "threads_per_worker": 1, "processes": False}
    with LocalCluster(**options, dashboard_address=None, silence_logs=50) as cluster:
        assert check_scheduler(cluster.scheduler_address) is None
        with pytest.raises(GraphError, match="is a Dask Worker; needed: its scheduler"):
            check_scheduler(cluster.workers[0].address)


@pytest.mark.filterwarnings("ignore")
def test_stop_while_a_cluster_has_no_worker():
    from distributed import LocalCluster

    stop = Stop()
    threading.Timer(0.5, stop.ask).start()
    with LocalCluster(n_workers=0, dashboard_address=None, silence_logs=50) as cluster:
        kept = Kept()
        run_plan(Plan(cases(3), 2), simulate, kept, stop, cluster.scheduler_address)
    assert kept == []


@pytest.mark.parametrize(("cores", "threads"), [(1, 1), (6, 6), (64, 8)])
def test_a_run_has_as_many_threads_as_pay(monkeypatch, cores, threads):
    monkeypatch.setattr("dask.system.cpu_count", lambda: cores)
    assert usual_workers() == threads
