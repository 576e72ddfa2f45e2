"""The measurements of `make bench`, at a tiny size: every row is there, and its figures agree."""

import time
from importlib import import_module

import numpy as np
import pytest

from sweep.scene.lattice import build_scene
from sweep.scene.loading import stages
from sweep.simulation.simulate import simulate
from tests.studies.bench import densify, growth, opensees, scenes, sweeps
from tests.studies.bench.measuring import alone, cases, clock, marching
from tests.studies.bench.measuring.crushes import COLLAPSED, Crush
from tests.studies.bench.table import Table
from tests.support import readme
from tests.support.kernels.solving import at_rest


@pytest.fixture(scope="module")
def collapsed():
    return Crush(3, cases.SMOOTH, COLLAPSED)


def full(table, rows):
    """True if these rows have a value in every column, and no others are there.

    The size of the values is not checked: a time may be less than an empty loop on a busy machine.
    """
    names = {name for name, _ in table.texts}
    return names == set(rows) and all(
        np.isfinite(table.values[name, column]) for name in rows for column in table.columns
    )


def test_medians_meet_every_side_in_turn():
    order = []
    sides = {name: lambda name=name: order.append(name) or len(order) for name in "ab"}
    assert clock.medians(sides, 3) == {"a": 3.0, "b": 4.0}
    assert order == list("ababab")


def test_clock_counts_work_and_no_sleep():
    work = clock.seconds(lambda: sum(range(2_000_000)))
    assert work > 3.0 * clock.seconds(lambda: time.sleep(0.1)) > 0.0


def test_table_is_markdown():
    table = Table("what", (3, "power"))
    table.put("a", 3, 1234.5, "2 x")
    table.put("a", "power", 1.0)
    table.lack("b", "not installed")
    assert list(table.markdown()) == [
        "| what | 3 x 3 | power |",
        "|---|---|---|",
        "| a | 1,234 (2 x) | 1 |",
        "| b | not installed |  |",
    ]


def test_march_takes_the_iterations_of_a_simulation():
    case = cases.seed(2, 2e-3, cases.SMOOTH)
    spent = marching.whole(case, build_scene(case))
    assert spent.iterations == simulate(case).summary["newton_iterations"]


def test_march_that_fails_is_no_figure(monkeypatch):
    case = cases.crush(2, 0.6, 3)
    scene, usual = build_scene(case), marching.tolerances
    monkeypatch.setattr(marching, "tolerances", lambda *of: usual(*of)._replace(iterations=0))
    with pytest.raises(RuntimeError, match="did not converge"):
        marching.press(case, scene, at_rest(scene), (0.0, 0.6), 3)


def test_crush_goes_on_from_where_it_was(collapsed):
    before = collapsed.state.x.copy()
    first, second = collapsed.onwards(), collapsed.onwards()
    assert np.array_equal(collapsed.state.x, before)
    assert first[0].iterations == second[0].iterations
    assert np.array_equal(first[1].x, second[1].x)
    travel = (first[1].x - before)[-1] / collapsed.case.lattice.height
    assert travel == pytest.approx(COLLAPSED[0] - COLLAPSED[1])


def test_scenes_are_compared_with_the_first_row():
    table = scenes.left_out(20, 1)
    assert full(table, ["the full model", *scenes.LEFT_OUT])
    assert table.texts["the full model", scenes.EACH].endswith("(1 x)")
    collapse = scenes.collapse((2,), 1)
    assert full(collapse, ["without contact", "with contact"])


def test_seed_scene_has_a_row_for_what_is_not_installed(monkeypatch):
    def absent():
        raise ImportError("openseespy")

    monkeypatch.setattr(opensees, "library", absent)
    table = scenes.seed(2, 2e-3, 1)
    assert table.texts["OpenSees, ProfileSPD", scenes.WHOLE] == "not installed"
    assert table.values[scenes.SEED, scenes.ITERATIONS] > 20.0


def test_growth_is_fitted_over_all_sizes(monkeypatch):
    assert growth.exponent([1, 2, 4], [3.0, 12.0, 48.0]) == pytest.approx(2.0)
    monkeypatch.setattr(growth, "alone", lambda case: {alone.MEMORY: case.lattice.cells_x})
    table = growth.table((1, 2), 3, 1)
    assert table.row(growth.PEAK) == {1: 1, 2: 2}
    assert table.values[growth.TOTAL, 2] > 0.0
    assert table.row(growth.EACH).keys() == {1, 2, "power"}
    ratio = table.values[growth.EACH, 2] / table.values[growth.EACH, 1]
    assert table.row(growth.RATIO) == {2: pytest.approx(ratio)}


def test_process_alone_tells_its_own_memory():
    summary = alone.alone(cases.crush(1, 0.02, 2))
    assert summary["status"] == "converged"
    assert 50.0 < summary[alone.MEMORY] < 1000.0


def test_sweep_with_a_failure_is_no_figure(monkeypatch):
    failing, simulating = cases.crush(2, 0.6, 3), import_module("sweep.simulation.simulate")
    usual = simulating.tolerances
    monkeypatch.setattr(simulating, "tolerances", lambda *of: usual(*of)._replace(iterations=0))
    with pytest.raises(SystemExit, match=rf"^case {failing.case_id}: no equilibrium"):
        sweeps.swept([failing], 1)


def test_long_crush_says_when_it_densifies(monkeypatch):
    monkeypatch.setattr(densify, "alone", lambda case: simulate(case).summary | {alone.MEMORY: 1.0})
    table = densify.table(2, 0.75, 30)
    assert full(table, ["to 75 % in 30 steps"])


def test_opensees_moves_as_we_do():
    pytest.importorskip("openseespy")
    case = cases.seed(2, 0.02)
    scene = build_scene(case)
    peer, state = scenes.PEERS["OpenSees, ProfileSPD"](case, scene), at_rest(scene)
    marching.go(case, scene, state, [phase.stage for phase in stages(case, scene)[:1]])
    assert peer.whole(released=False).iterations > 100
    own = (state.x - scene.x_rest)[: scene.mesh.points.size].reshape(-1, 2)
    joints = np.arange(scene.mesh.n_joints)
    atol = 0.02 * np.abs(own[joints, 1]).max()
    np.testing.assert_allclose(peer.moved()[joints, 1], own[joints, 1], atol=atol)


def test_readme_shows_rows_of_the_bench():
    said = {row[0] for table in readme.tables() for row in table}
    others = {growth.EACH, growth.PEAK, "with friction", "hex, CHOLMOD", *scenes.LEFT_OUT}
    assert {scenes.SEED, *scenes.ALLOWED, *scenes.PEERS, *scenes.LARGER, *others} <= said
