"""A case that has not converged ends a study, with its sentence."""

import pytest

from sweep.config.case import Case
from sweep.store.read import read_summary
from tests.support.converged import converged, demand, swept

PRESSED = Case.of(
    lattice=dict(cells_x=1, cells_y=1, nodes_per_wall=1),
    loading=dict(mode="displacement", strain=0.005),
    solver=dict(load_steps=2),
)
STOPPED = Case.of(
    loading=dict(mode="displacement"),
    solver=dict(load_steps=20, max_iterations=2),
    axes={"solver.max_iterations": 2},
)


def test_what_converges_goes_on(tmp_path):
    assert converged(PRESSED).status == "converged"
    rows = swept([PRESSED], tmp_path / "some.h5")
    assert list(rows["case_id"]) == [PRESSED.case_id]


def test_what_stops_ends_a_study(tmp_path):
    named = rf"^case {STOPPED.case_id}, solver.max_iterations = 2: no equilibrium .* while loading"
    with pytest.raises(SystemExit, match=named):
        converged(STOPPED)
    file = tmp_path / "some.h5"
    with pytest.raises(SystemExit, match=f"^case {STOPPED.case_id}: no equilibrium"):
        swept([PRESSED, STOPPED], file)
    assert len(read_summary(file)) == 2
    assert list(swept([PRESSED], file)["case_id"]) == [PRESSED.case_id]
    rows = [{"case_id": name, "status": "stopped", "message": "why"} for name in "ab"]
    with pytest.raises(SystemExit, match=r"^case a: why\ncase b: why$"):
        demand(rows)
