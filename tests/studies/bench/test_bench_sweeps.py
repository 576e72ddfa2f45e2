"""Sweeps that the bench times: time lost to other programs, and errors of the designs."""

import pytest

from tests.studies.bench import sweeps
from tests.studies.bench.measuring import cases, clock


def test_thousand_designs_are_a_thousand():
    designs = sweeps.thousand()
    lattices = [case.lattice for case in designs]
    assert len({case.case_id for case in designs}) == 1000
    assert {case.material.name for case in designs} == {"ninjaflex", "ultimaker_tpu95a"}
    assert {(cells.cells_x, cells.cells_y) for cells in lattices} >= {(3, 3), (5, 5)}
    assert all(case.contact.model == "barrier" for case in designs)
    assert {case.loading.strain for case in designs} == {0.6}


@pytest.mark.parametrize(
    ("workers", "others", "wall", "lost"),
    [(1, 10.0, 10.0, 0.0), (1, 20.0, 15.0, 5.0), (2, 5.0, 7.5, 2.5), (2, 10.0, 10.0, 5.0)],
)
def test_what_other_programs_take_of_the_clock(workers, others, wall, lost):
    """Two cores, 10 s of work, shared fairly."""
    assert sweeps.lost(others, wall, workers, cores=2) == pytest.approx(lost)
    assert wall - lost == pytest.approx(10.0 / workers)


def test_processors_are_busy_while_one_computes():
    before = sweeps.busy()
    spent = clock.seconds(lambda: [k * k for k in range(5_000_000)])
    assert sweeps.busy() - before > 0.5 * spent - 0.02


def test_sweeps_are_timed_and_checked():
    rough, fine = (sweeps.errors([cases.crush(2, 0.1, steps)]) for steps in (4, 64))
    assert rough > 4.0 * fine > 0.0
    smooth = [cases.crush(2, 0.1, 5, contact) for contact in (cases.SMOOTH, cases.ROUGH)]
    throughput = sweeps.throughput(smooth, 1)
    found = throughput.row("with friction")
    assert found["per s"] > 1.0
    assert found["wall, s"] > 0.5e-3 * 2 * found["CPU, ms"] > 0.0
    taken = 0.5e-3 * found["CPU, ms"] * found[sweeps.RATIO]
    assert found["per s"] == pytest.approx(1.0 / taken)
    assert throughput.values["without friction", "error, %"] > 0.0
