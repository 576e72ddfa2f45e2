"""A small block of a sheet within perimeters is crushed until it touches itself, and released."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate

SIDE = 2.5e-3  # half a period


@pytest.mark.parametrize(
    ("direction", "platen"), [("out_of_plane", "glued"), ("in_plane", "contact")]
)
def test_a_block_is_crushed_and_released(direction, platen):
    sizes = dict.fromkeys(("width", "height", "depth"), SIDE)
    sheet = dict(slicer="prusa", pattern="gyroid", infill=0.2, perimeters=1, nodes_per_wall=2)
    case = Case.of(
        lattice=sizes | sheet | {"imperfection": 0.02},
        material={"name": "cheetah"},
        loading={"mode": "displacement", "direction": direction, "strain": 0.5, "platen": platen},
    )
    result = simulate(case)
    found = result.summary
    assert found["status"] == "converged"
    assert found["max_crossings"] == 0
    assert found["touched"]
    assert abs(found["energy_residual_J"]) < 1e-8 * found["absorbed_energy_J"]
    top, bottom = (result.history[f"reaction_{end}_N"] for end in ("top", "bottom"))
    np.testing.assert_allclose(top, bottom, atol=1e-3 * np.abs(top).max())
