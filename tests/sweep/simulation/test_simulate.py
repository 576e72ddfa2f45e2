"""The processor time that a case says it took."""

import time
from importlib import import_module

import pytest

from sweep.config.case import Case
from sweep.config.faults import ConfigError
from sweep.simulation.simulate import simulate
from sweep.simulation.warm_up import warm_up


def test_tables_of_a_config_are_a_case_too():
    tables = {"loading": {"release_time": "0.1 ms", "duration": "0.2 ms"}}
    assert simulate(tables).case == Case.of(loading=dict(release_time=1e-4, duration=2e-4))
    with pytest.raises(ConfigError, match=r"lattice\.widht"):
        simulate({"lattice": {"widht": "9 mm"}})


def busy():
    """Keep the processor busy."""
    end = time.thread_time() + 0.2
    while time.thread_time() < end:
        pass


@pytest.mark.parametrize(
    ("module", "part", "first", "counts"),
    [
        ("sweep.simulation.simulate", "build_scene", busy, True),
        ("sweep.simulation.simulate", "history_columns", busy, True),
        ("sweep.simulation.simulate", "summarise", busy, True),
        ("kernels.solve.march", "march", busy, True),
        ("kernels.solve.march", "march", lambda: time.sleep(0.2), False),
    ],
)
def test_processor_time_counts_python_and_the_march_but_no_waiting(
    monkeypatch, module, part, first, counts
):
    warm_up()
    whole = getattr(import_module(module), part)
    monkeypatch.setattr(f"{module}.{part}", lambda *given: first() or whole(*given))
    case = Case.of(loading=dict(release_time=1e-4, duration=2e-4))
    assert (simulate(case).summary["cpu_s"] > 0.2) == counts
