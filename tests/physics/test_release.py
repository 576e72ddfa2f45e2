"""After a dead load is released, damping acts, however weak it is."""

import numpy as np
import pytest

from sweep.config.case import Case
from tests.support.converged import converged


def released(force, friction, integrator):
    """Hexagons between loose plates under a ``force`` (N) for 30 ms, then free for 20 ms."""
    return Case.of(
        lattice={"kind": "hex"},
        material={"name": "cheetah"},
        loading={
            "mode": "force",
            "platen": "contact",
            "force": force,
            "duration": 0.05,
            "release_time": 0.03,
        },
        contact={"friction": friction},
        solver={"time_step": 1e-4, "integrator": integrator},
    )


@pytest.mark.parametrize("integrator", ["backward_euler", "newmark", "bdf2"])
@pytest.mark.parametrize("friction", [0.0, 0.5])
@pytest.mark.parametrize("force", [2e-4, 9e-3])
def test_the_book_of_a_load_below_the_weight_of_the_lattice_closes(force, friction, integrator):
    """Damping is then a force below the admissible residual."""
    result = converged(released(force, friction, integrator))
    left = np.abs(result.history["energy_residual_J"]).max()
    assert left < 1e-3 * np.abs(result.history["work_in_J"]).max()
