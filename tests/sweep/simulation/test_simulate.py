"""The processor time that a case says it took."""

import time
from importlib import import_module

import pytest

from kernels.solve import march
from sweep.config.case import Case
from sweep.config.faults import ConfigError
from sweep.simulation.simulate import simulate, warm_up

PARTS = {"scene": "build_scene", "rows": "history_columns", "measures": "summarise"}


def work(seconds):
    """Keep the processor busy."""
    end = time.thread_time() + seconds
    while time.thread_time() < end:
        pass


def before(first, function):
    """The function, with something done before."""

    def both(*arguments):
        first(0.2)
        return function(*arguments)

    return both


@pytest.fixture
def seconds(monkeypatch):
    """Processor time of a small case, which starts with other work."""
    warm_up()
    case = Case.of(loading=dict(release_time=1e-4, duration=2e-4))

    def measure(module, name, first):
        monkeypatch.setattr(module, name, before(first, getattr(module, name)))
        return simulate(case).summary["cpu_s"]

    return measure


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_processor_time_counts_what_is_done_in_python(seconds, part):
    assert seconds(import_module("sweep.simulation.simulate"), part, work) > 0.2


def test_processor_time_counts_the_march(seconds):
    assert seconds(march, "march", work) > 0.2


def test_processor_time_counts_no_waiting(seconds):
    assert seconds(march, "march", time.sleep) < 0.2


def test_tables_of_a_config_are_a_case_too():
    tables = {"loading": {"release_time": "0.1 ms", "duration": "0.2 ms"}}
    assert simulate(tables).case == Case.of(loading=dict(release_time=1e-4, duration=2e-4))
    with pytest.raises(ConfigError, match=r"lattice\.widht"):
        simulate({"lattice": {"widht": "9 mm"}})
