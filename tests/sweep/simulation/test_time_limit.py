"""Time limits: cases that take too long are stopped, by one thread for all."""

import os
import threading
import time

import pytest

from sweep.simulation import time_limit as home
from sweep.simulation.time_limit import Watch

SOON, LATE = 0.02, 60.0
ENOUGH = 0.3  # a block that does nothing ends sooner, on a busy machine too


@pytest.fixture
def watch():
    return Watch()


def test_what_takes_too_long_is_told_in_time(watch):
    told, started = threading.Event(), time.monotonic()
    with watch.limit(SOON, told.set):
        assert told.wait(5.0)
        assert time.monotonic() - started >= SOON


def test_what_ends_in_time_is_never_told(watch):
    told = threading.Event()
    with watch.limit(ENOUGH, told.set):
        pass
    time.sleep(1.5 * ENOUGH)
    assert not told.is_set()


def test_shorter_limit_is_not_kept_waiting_by_a_longer_one(watch):
    long, short = threading.Event(), threading.Event()
    with watch.limit(LATE, long.set), watch.limit(SOON, short.set):
        assert short.wait(5.0)
    assert not long.is_set()


def test_all_share_one_thread_that_ends_when_idle(watch, monkeypatch):
    monkeypatch.setattr(home, "IDLE", SOON)
    with watch.limit(LATE, lambda: None):
        thread = watch._thread
        for _ in range(20):
            with watch.limit(LATE, lambda: None):
                assert watch._thread is thread
    with watch.limit(SOON, lambda: None):  # which makes it look
        thread.join(5.0)
    thread.join(5.0)
    assert not thread.is_alive()
    told = threading.Event()
    with watch.limit(SOON, told.set):
        assert told.wait(5.0)


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_forked_process_watches_by_itself(watch):
    """Whose threads it has not got, and whose lock may be held."""
    with watch.limit(LATE, lambda: None), watch._changed:
        child = os.fork()
        if child == 0:
            told = threading.Event()
            with watch.limit(LATE, lambda: None), watch.limit(SOON, told.set):
                os._exit(0 if told.wait(5.0) else 1)
        assert os.waitpid(child, 0)[1] == 0


def test_error_in_the_block_passes_and_ends_its_limit(watch):
    told = threading.Event()
    with pytest.raises(KeyError), watch.limit(ENOUGH, told.set):
        raise KeyError
    time.sleep(1.5 * ENOUGH)
    assert not told.is_set()
