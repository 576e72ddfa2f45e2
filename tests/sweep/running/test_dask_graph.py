"""Cases on real workers: every case once, whatever happens to workers, scheduler and neighbours."""

import os
import shutil
import time
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace
from unittest.mock import Mock

import pytest
from distributed import KilledWorker

from sweep.result import Status
from sweep.running.batches import Plan
from sweep.running.child_process import run_alone
from sweep.running.cluster import ClusterError, open_cluster
from sweep.running.dask_graph import LOSSES, Suspects, Work, _Run, run_on_cluster
from sweep.running.fingerprint import OtherSourceError, source_hash
from sweep.running.sweep import run_sweep
from sweep.running.threads import Stop, run_batch
from sweep.running.warming import Kernels, inspect_kernels, load
from sweep.store.read import read_statuses
from tests.support.cluster import ROOT, Processes
from tests.support.results.standin import Kept, cases, number_of, simulate

pytestmark = pytest.mark.filterwarnings("ignore:.*never retrieved")
FOREVER = 60.0  # seconds


@pytest.fixture(scope="module")
def shared(tmp_path_factory):
    """A scheduler with two workers, for tests that leave it as it was."""
    with Processes(tmp_path_factory.mktemp("shared")) as processes:
        processes.add(2)
        yield processes


def brief(case, control=None):
    """A case of 20 ms."""
    time.sleep(0.02)
    return simulate(case)


def poisonous(case, control=None):
    """Case 11 takes its process with it; the others take a moment."""
    if number_of(case) == 11:
        os._exit(1)
    return brief(case)


def ran(batch, where, simulate=brief, suspects=()):
    """The batches that come from a cluster, and the lines about it."""
    kept, lines = Kept(), []
    plan, work = Plan(batch, 2), Work(simulate, [])
    with open_cluster(where, FOREVER) as cluster:
        run_on_cluster(plan, work, kept, Stop(), cluster, lines.append, suspects)
    return kept, lines


def test_two_runs_share_a_scheduler_that_stays_as_it_is(shared, tmp_path):
    def settings(dask_scheduler):
        return dask_scheduler.allowed_failures, [*dask_scheduler.plugins]

    def run(first):
        out = tmp_path / f"{first}.h5"
        run_sweep(cases(60, first), out, scheduler=shared.address, simulate=brief)
        return read_statuses(out).keys()

    with open_cluster(str(shared.file)) as cluster:
        before = cluster.client.run_on_scheduler(settings)
        with ThreadPoolExecutor(2) as pool:
            ids = [*pool.map(run, (0, 100))]
        assert cluster.client.run_on_scheduler(settings) == before
        assert (
            cluster.client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks)) == 0
        )
    assert ids == [{case.case_id for case in cases(60, first)} for first in (0, 100)]


def test_case_that_kills_its_worker_is_a_row_and_its_neighbours_succeed(shared):
    batch = cases(16)
    kept, lines = ran(batch, shared.address, poisonous)
    statuses = {number_of(case): kept.results[case.case_id].status for case in batch}
    assert statuses.pop(11) is Status.WORKER_DIED
    assert statuses.pop(7) is Status.STOPPED
    assert set(statuses.values()) == {Status.CONVERGED}
    assert sum(map(len, kept)) == 16
    assert lines == []
    with open_cluster(shared.address) as cluster:
        assert len(cluster.client.nthreads()) == 1  # it killed one worker, and no second one
    shared.add()


def test_stop_keeps_what_has_landed(shared):
    stop, kept = Stop(), Kept()

    def sink(results):
        kept(results)
        stop.ask()

    with open_cluster(shared.address) as cluster:
        work = Work(brief, [])
        run_on_cluster(Plan(cases(400), 2), work, sink, stop, cluster, print)
        assert cluster.client.futures == {}
    assert 0 < sum(map(len, kept)) < 400


def test_a_worker_of_another_source_is_refused_by_name(shared, tmp_path):
    other = tmp_path / "other"
    for package in ("kernels", "sweep", "tests/support"):
        shutil.copytree(ROOT / package, other / package)
    with (other / "sweep" / "result.py").open("a") as file:
        file.write("# changed\n")
    (process,) = shared.add(source=other, name="old")
    with open_cluster(shared.address) as cluster:
        while len(cluster.client.nthreads()) < 3:
            time.sleep(0.05)
    kept, (line,) = ran(cases(120), shared.address)
    process.kill()
    assert len(kept.results) == 120
    assert line.startswith("worker old (tcp://127.0.0.1:")
    assert f"is refused: it has source {source_hash(other / 'kernels', other / 'sweep')} " in line


def test_workers_come_and_go_and_a_lost_scheduler_ends_the_run(shared, tmp_path):
    """The only worker is killed, another one comes, then the scheduler is killed."""
    lines = []
    with Processes(tmp_path) as processes:
        (worker,) = processes.add()

        def kill(results):
            kept(results)
            worker.kill()
            if lines and lines[-1].startswith("there are workers again"):
                processes.scheduler.kill()

        def say(line):
            lines.append(line)
            if "no worker is left" in line:
                processes.add()

        kept = Kept()
        lost = "lost the Dask scheduler at tcp://.*; what is finished is kept, and the same command"
        with (
            open_cluster(str(processes.file), FOREVER) as cluster,
            pytest.raises(ClusterError, match=lost),
        ):
            run_on_cluster(Plan(cases(200), 2), Work(brief, []), kill, Stop(), cluster, say)
    assert 1 < len(kept.results) < 200
    assert lines[-2:] == [
        f"no worker is left at {cluster.address}; waiting 60 s for one",
        "there are workers again: 1",
    ]


class Recorded:
    """A run on workers that do nothing, and the calls submitted to them."""

    def __init__(self, count=0, workers=(), kernels=("marches",)):
        self.calls, self.lines = [], []
        client = SimpleNamespace(
            run_on_scheduler=lambda _: self.workers,
            status="running",
            scheduler=SimpleNamespace(address="tcp://s:1"),
            submit=self.submit,
            cancel=lambda futures: None,
        )
        cluster = SimpleNamespace(client=client, wait=FOREVER, address="tcp://s:1")
        work = Work(simulate, list(kernels))
        self.run = _Run(cluster, Plan(cases(count), 1), work, Stop(), self.lines.append)
        self.workers = {}
        for name in workers:  # join, each with a thread
            self.workers[name] = name, name[0], 1
            self.run._look()

    def submit(self, _, __, function, *arguments, workers, pure):
        """Note a call, and give it a future that ends when the test says so."""
        future = Mock()
        self.calls.append((workers[0], function, arguments, future))
        return future

    def end(self, *values):
        """End the first calls with these values."""
        for value in values:
            *_, future = self.calls.pop(0)
            self.run._land(future, value)

    @property
    def waiting(self):
        """The called workers and functions."""
        return [(worker, function) for worker, function, *_ in self.calls]


COLD, WARM = Kernels(["marches"], True), Kernels([], True)


def test_one_worker_of_a_host_compiles_first():
    recorded = Recorded(8, ("a1", "a2", "b1"))
    recorded.end(COLD, COLD, COLD)
    assert recorded.waiting == [("a1", load), ("b1", load)]
    assert [line.split(": ")[0] for line in recorded.lines] == [
        "worker a1 compiles the kernels of its host, once",
        "worker b1 compiles the kernels of its host, once",
    ]
    recorded.end(None)
    assert recorded.waiting == [("b1", load), ("a1", inspect_kernels), ("a2", inspect_kernels)]
    recorded.end(None, WARM)
    assert recorded.waiting[-1][0] == "a1"
    assert len(recorded.calls[-1][2][1]) == 1  # the first batch is one case


def test_where_nothing_lasts_each_worker_compiles():
    recorded = Recorded(8, ("a1", "a2"))
    recorded.end(*[COLD._replace(lasting=False)] * 2)
    assert recorded.waiting == [("a1", load), ("a2", load)]


def test_when_the_compiling_worker_is_lost_another_one_compiles():
    recorded = Recorded(8, ("a1", "a2"))
    recorded.end(COLD, COLD)
    del recorded.workers["a1"], recorded.calls[:]
    recorded.run._look()
    assert recorded.waiting == [("a2", inspect_kernels)]
    recorded.end(COLD)
    assert recorded.waiting == [("a2", load)]


def test_a_worker_that_cannot_run_it_gets_nothing_more_and_its_cases_go_back():
    recorded = Recorded(3, ("a1",), kernels=())
    recorded.end(WARM)
    assert len(recorded.run.plan) == 2
    recorded.end(ModuleNotFoundError("No module named 'scipy'"))
    assert len(recorded.run.plan) == 3
    assert recorded.waiting == []
    (line,) = recorded.lines
    assert line.startswith("worker a1 is refused: ")
    assert "No module named 'scipy'" in line


def test_if_no_worker_fits_the_run_ends_with_the_reason():
    recorded = Recorded(3, ("a1",), kernels=())
    recorded.run.cluster.wait = 0.0
    recorded.end(OtherSourceError("numba 0.60.0 (this run: 0.61.2)"))
    recorded.run._look()
    why = r"tcp://s:1 for 0 s; worker a1 is refused: it has numba 0.60.0 \(this run: 0.61.2\)"
    with pytest.raises(ClusterError, match=why):
        recorded.run._look()


def test_suspects_run_first_each_in_a_process_of_its_own():
    recorded = Recorded(3, kernels=())
    recorded.run.suspects += [Suspects([case]) for case in cases(5)[3:]]
    recorded.workers["a1"] = "a1", "a", 1
    recorded.run._look()
    recorded.end(WARM)
    for case in reversed(cases(5)[3:]):
        ((_, function, arguments, _),) = recorded.calls
        assert (function, arguments) == (run_alone, (simulate, [case]))
        recorded.end([simulate(case)])
    assert recorded.waiting == [("a1", run_batch)]


def test_a_worker_that_dies_and_is_back_under_its_address_is_inspected_again():
    recorded = Recorded(3, ("a1",))
    recorded.end(COLD, KilledWorker("load", None, 3))
    assert recorded.waiting == []
    recorded.run._look()
    assert recorded.waiting == [("a1", inspect_kernels)]
    recorded.end(COLD)
    assert recorded.waiting == [("a1", load)]


def test_a_case_to_which_workers_are_lost_again_and_again_is_a_row():
    run = Recorded().run
    assert run._suspect(Suspects(cases(4))) == []
    assert [len(suspects.cases) for suspects in run.suspects] == [2, 2]
    rows = run._suspect(Suspects(cases(1), LOSSES - 1))
    assert [(row.status, row.case) for row in rows] == [(Status.WORKER_DIED, cases(1)[0])]
    assert f"each of {LOSSES} workers" in rows[0].message


def test_long_cases_are_not_taken_ahead():
    recorded = Recorded(40, ("a1",), kernels=())
    recorded.end(WARM)
    (first,) = recorded.calls[0][2][1]
    recorded.end(([simulate(first)], 100.0))
    assert len(recorded.calls) == 1
    for _ in range(12):
        recorded.run.plan.learn(cases(9), 0.01)
    (second,) = recorded.calls[0][2][1]
    recorded.end(([simulate(second)], 0.001))
    assert len(recorded.calls) > 1
