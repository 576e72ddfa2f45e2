"""History columns of structures: their load, their probes, and their reactions."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.scene.custom import build_structure
from sweep.simulation.custom_history import structure_columns
from tests.support.designs.structures import BEAM, MATERIAL, end_load, probe, pushed, structure


def test_rows_of_equal_increments():
    result = pushed(BEAM | end_load(-1e-3), steps=4)
    np.testing.assert_allclose(result.history["load_factor"], [0.0, 0.25, 0.5, 0.75, 1.0])
    for table in (result.history, result.frames):
        assert np.isnan(table["strain"]).all()
    reaction = probe(result, 0, "reaction_y_N")
    np.testing.assert_allclose(reaction, 1e-3 * result.history["load_factor"], rtol=1e-6)


@pytest.mark.parametrize("floor", [{}, {"floor_y_mm": -5.0}])
def test_reactions_are_zero_where_a_node_is_free(floor):
    parts = BEAM | floor | {"probes": [1, 0]}
    lattice = dict(kind="custom", structure=structure(**parts))
    case = Case.of(lattice=lattice, material=MATERIAL, solver=dict(integrator="static"))
    probed = np.arange(24.0).reshape(2, 2, 6)
    given = {"time_s": np.array([0.0, 0.5]), "reaction_bottom_N": np.array([1.0, 2.0])}
    found = structure_columns(given, probed, build_structure(case), case)
    assert found["probe_1_x_m"].tolist() == [0.0, 12.0]
    assert found["probe_0_rotation_rad"].tolist() == [5.0, 17.0]
    assert found["probe_0_reaction_y_N"].tolist() == [10.0, 22.0]
    for name in ("reaction_x_N", "reaction_y_N", "reaction_moment_Nm"):
        assert not found[f"probe_1_{name}"].any()
    assert found["load_factor"].tolist() == [0.0, 0.5]
    assert np.isnan(found["reaction_bottom_N"]).all() == (not floor)
    assert np.isnan(found["reaction_top_N"]).all()
