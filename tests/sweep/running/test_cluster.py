"""Allowed schedulers, and the messages for anything else."""

import asyncio
import json
import socket
import sys
from types import ModuleType

import dask
import pytest

from sweep.running.cluster import (
    Cluster,
    ClusterError,
    SchedulerError,
    address_of,
    check_scheduler,
    open_cluster,
)

# Dask leaves sockets of clusters that never started to the garbage collector.
pytestmark = pytest.mark.filterwarnings(
    "ignore:Exception ignored in. <socket:pytest.PytestUnraisableExceptionWarning"
)

HERE = {"processes": False, "dashboard_address": ":0", "silence_logs": 50}


@pytest.fixture
def dask_cluster():
    """A scheduler of Dask in this process, without workers."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=0, **HERE) as cluster:
        yield cluster


@pytest.mark.parametrize("address", ["tcp://", "http://host:80", "://"])
def test_what_is_no_address_is_refused_in_one_line(address):
    with pytest.raises(SchedulerError, match="such as tcp://host:8786") as refusal:
        check_scheduler(address)
    assert str(refusal.value).startswith(f'"{address}" is no address')
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("where", ["nonsense", "", "host:8786", "none.json", "Slurm"])
def test_what_is_neither_address_nor_file_is_refused(where):
    with pytest.raises(SchedulerError, match="is no scheduler and no file; allowed: an address"):
        address_of(where)


@pytest.mark.filterwarnings("ignore")
def test_worker_is_no_scheduler():
    from distributed import LocalCluster

    with LocalCluster(n_workers=1, threads_per_worker=1, **HERE) as cluster:
        assert check_scheduler(cluster.scheduler_address) is None
        with pytest.raises(SchedulerError, match="is a Dask Worker; needed: its scheduler"):
            check_scheduler(cluster.workers[0].address)


def test_a_scheduler_file_has_the_address(tmp_path):
    file = tmp_path / "scheduler.json"
    file.write_text(json.dumps({"type": "Scheduler", "address": "tcp://10.0.0.1:8786"}))
    assert address_of(str(file)) == "tcp://10.0.0.1:8786"
    for text in ("", "[]", "{}", "\xff"):
        file.write_text(text)
        with pytest.raises(SchedulerError, match="is no scheduler file; allowed"):
            address_of(str(file))


def test_a_scheduler_is_named(dask_cluster, capsys):
    with open_cluster(dask_cluster.scheduler_address, 5.0) as cluster:
        assert cluster.wait == 5.0
        assert cluster.client.status == "running"
        with open_cluster(cluster) as same:
            assert same is cluster
    assert cluster.client.status == "closed"
    line = f"running on the Dask cluster at {dask_cluster.scheduler_address}\n"
    assert capsys.readouterr().err == line


def test_an_object_of_dask_is_taken_and_stays_open(dask_cluster):
    from distributed import Client

    with open_cluster(dask_cluster) as cluster:
        assert cluster.address == dask_cluster.scheduler_address
    with Client(dask_cluster, set_as_default=False) as client:
        with open_cluster(client) as cluster:
            assert cluster == Cluster(client, dask_cluster.scheduler_address, 60.0)
        assert client.status == "running"
    assert dask_cluster.status.name == "running"


def test_an_asynchronous_client_is_refused(dask_cluster):
    from distributed import Client

    async def ask():
        address = dask_cluster.scheduler_address
        async with Client(address, asynchronous=True, set_as_default=False) as client:
            open_cluster(client).__enter__()

    with pytest.raises(SchedulerError, match="allowed: one with asynchronous=False"):
        asyncio.run(ask())


def test_something_else_is_refused():
    with pytest.raises(SchedulerError, match="the Dask scheduler 8786: "):
        open_cluster(8786).__enter__()


def test_slurm_without_its_package_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "dask_jobqueue.slurm", None)
    with pytest.raises(SchedulerError, match=r'pip install "crumple\[slurm\]"') as refusal:
        open_cluster("slurm").__enter__()
    assert (refusal.value.exit_status, ClusterError.exit_status) == (2, 1)


@pytest.fixture
def jobqueue(monkeypatch, dask_cluster):
    """A module in place of dask-jobqueue; its cluster records the requests to it."""
    asked = {}
    module = ModuleType("dask_jobqueue.slurm")
    module.SLURMCluster = lambda: dask_cluster
    monkeypatch.setattr(dask_cluster, "adapt", asked.update)
    monkeypatch.setitem(sys.modules, "dask_jobqueue.slurm", module)
    return module, asked


def test_slurm_keeps_as_many_workers_as_dask_is_configured_for(jobqueue, dask_cluster, capsys):
    with dask.config.set({"distributed.adaptive.maximum": 64}), open_cluster("slurm") as cluster:
        assert cluster.address == dask_cluster.scheduler_address
    assert jobqueue[1] == {"minimum": 64, "maximum": 64}
    assert dask_cluster.status.name == "closed"
    assert capsys.readouterr().err.startswith("running on the Dask cluster of slurm at ")


def test_slurm_needs_its_configuration(jobqueue):
    with pytest.raises(SchedulerError, match=r"slurm: distributed\.adaptive\.maximum, the"):
        open_cluster("slurm").__enter__()

    def unset():
        raise ValueError("You must specify how much cores and memory\nper job")

    jobqueue[0].SLURMCluster = unset
    needed = "how much cores and memory per job; needed: jobqueue.slurm in a file"
    with (
        dask.config.set({"distributed.adaptive.maximum": 64}),
        pytest.raises(SchedulerError, match=needed),
    ):
        open_cluster("slurm").__enter__()


def test_server_that_is_not_there_or_never_answers(monkeypatch):
    monkeypatch.setattr("sweep.running.cluster.ANSWER", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as server:
        for address in ("tcp://127.0.0.1:9", "tcp://{}:{}".format(*server.getsockname())):
            with pytest.raises(SchedulerError, match=f"no Dask scheduler answers at {address}"):
                check_scheduler(address)
