"""Sheets: a small block within perimeters is crushed and released, a panel is struck."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate

SIDE = 2.5e-3  # half a period
ENERGY = 3e-3  # J


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
    assert abs(found["energy_residual_J"]) < 1e-6 * found["absorbed_energy_J"]
    top, bottom = (result.history[f"reaction_{end}_N"] for end in ("top", "bottom"))
    np.testing.assert_allclose(top, bottom, atol=1e-3 * np.abs(top).max())


def test_a_struck_sheet_returns_less_if_it_loses_energy():
    returned = []
    for loss in (0.0, 0.3):
        case = Case.of(
            lattice={"kind": "gyroid", "depth": 6e-3, "cell_size": 6e-3, "nodes_per_wall": 2}
            | {"wall_thickness": 0.4e-3},
            material={"name": "cheetah"} | ({"loss": loss} if loss else {}),
            loading={"mode": "impact", "direction": "out_of_plane", "platen": "glued"}
            | {"energy": ENERGY, "striker_mass": 2e-3},
        )
        result = simulate(case)
        found = result.summary
        assert (found["status"], found["max_crossings"]) == ("converged", 0)
        assert found["absorbed_energy_J"] == pytest.approx(ENERGY, rel=1e-2)
        assert abs(found["energy_residual_J"]) < 1e-8 * ENERGY
        spent = result.history["dissipated_material_J"][-1]
        assert spent > 0.1 * ENERGY if loss else spent == 0.0
        returned.append(found["returned_energy_J"])
    assert np.diff(returned) < -0.1 * ENERGY
