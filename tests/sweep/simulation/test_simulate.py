"""Tables as a case, the stored shapes, and the processor time that a case says it took."""

import time
from importlib import import_module

import numpy as np
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


@pytest.mark.parametrize("loss", [0.0, 0.3])
@pytest.mark.parametrize("solver", [{}, {"accuracy": 0.01}, {"load_steps": 80}])
def test_stored_shapes_are_even(loss, solver):
    """Walls that relax have 32 rows where others have one, most of which their steps leave out."""
    loading = {"mode": "displacement", "strain": 0.6}
    material = {"name": "ninjaflex", "loss": loss}
    result = simulate({"material": material, "loading": loading, "solver": solver})
    strains = result.frames["strain"]
    assert strains[0] == strains[-1] == 0.0
    assert strains.max() == pytest.approx(0.6)
    assert len(strains) == 41
    assert abs(np.diff(strains)).max() < 0.06


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
