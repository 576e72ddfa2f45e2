"""What `make bench` measures, at a tiny size: every row is there, and its figures hang together."""

import time
from importlib import import_module

import numpy as np
import pytest

from kernels.terms.rows import CONTACT
from sweep.scene.lattice import build_scene
from sweep.simulation.simulate import simulate
from tests.studies.bench import (
    densify,
    figure,
    growth,
    iteration,
    kernels,
    lockstep,
    scenes,
    sweeps,
)
from tests.studies.bench.measuring import alone, cases, clock, counts, loops, marching
from tests.studies.bench.measuring.crushes import COLLAPSED, Crush
from tests.studies.bench.measuring.spot import Spot
from tests.studies.bench.peers import libraries, opensees
from tests.studies.bench.peers.matrix import assembled, reduction
from tests.studies.bench.table import Table
from tests.support import readme
from tests.support.kernels.solving import at_rest, whole
from tests.support.kernels.terms import by_home


@pytest.fixture(scope="module")
def collapsed():
    return Crush(3, cases.SMOOTH, COLLAPSED)


def full(table, rows):
    """True if these rows have a value in every column, and no others are there.

    Of its size nothing is asked: a time may be less than that of an empty loop on a busy machine.
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
    travel = collapsed.move[-1] * collapsed.steps / collapsed.case.lattice.height
    assert travel == pytest.approx(COLLAPSED[0] - COLLAPSED[1])


def test_parts_are_counted_as_they_are_called(collapsed):
    spent, _ = collapsed.onwards()
    often = counts.counted(collapsed)
    called = {part: share * spent.iterations for part, share in often.items()}
    assert called["evaluate"] >= spent.iterations + collapsed.steps  # each step sets out with one
    assert 0.0 < called["factor"] <= called["solve"] <= called["evaluate"]
    assert 1.0 <= called["room"] <= called["list"] < called["limit"]
    assert collapsed.onwards()[0].iterations == spent.iterations  # compiled again


def test_repeated_kernels_do_what_a_step_does(collapsed):
    spot = Spot(collapsed.scene, collapsed.state.x, collapsed.move)
    one = whole(collapsed.scene, collapsed.state.x)
    energy = loops.repeat(
        loops.EVALUATE,
        2,
        spot.x,
        spot.move,
        spot.most,
        spot.whole.problem,
        spot.whole.step,
        spot.found,
        spot.ones,
    )
    assert energy == pytest.approx(2.0 * one.energy(spot.x), rel=1e-12)
    assert spot.found.stored[CONTACT] > 0.0
    one.factor(spot.x)
    spot.each(loops.FACTOR)
    np.testing.assert_allclose(
        by_home(spot.whole.neighbours.system.matrix),
        by_home(one.neighbours.system.matrix),
        rtol=1e-9,
    )


def test_parts_make_up_an_iteration(collapsed):
    times = iteration.split(collapsed, 3)
    whole, rest = times.pop(iteration.WHOLE), times.pop(iteration.REST)
    assert len(times) > 4
    assert rest == pytest.approx(whole - sum(times.values()))


def test_tables_by_size_are_full():
    assert full(kernels.table((2,), 1), kernels.PARTS)
    collapse = scenes.collapse((2,), 1)
    assert full(collapse, ["without contact", "with contact"])
    split = iteration.table((2,), 1)
    assert {iteration.WHOLE, "factor"} < {name for name, _ in split.values}
    assert len(split.columns) == 2


def test_scenes_are_compared_with_the_first_row():
    table = scenes.left_out(20, 1)
    assert full(table, ["the full model", *scenes.LEFT_OUT])
    assert table.texts["the full model", scenes.EACH].endswith("(1 x)")
    crush = scenes.crush(20, 1)
    assert full(crush, ["without contact", "with contact"])


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


@pytest.mark.parametrize("inner", [0, 2])
def test_libraries_solve_the_matrix_of_a_step(inner):
    case = sweeps.changed(cases.crush(2, 0.1, 5), lattice={"nodes_per_wall": inner})
    scene = build_scene(case)
    state = at_rest(scene)
    marching.press(case, scene, state, (0.0, 0.1), 10)
    spot = Spot(scene, state.x, 1e-6 * np.ones(state.x.size))
    matrix = assembled(scene.terms, spot.whole.problem.buffers.stiffness)
    b = np.random.default_rng(0).normal(size=matrix.shape[0])
    solutions = [solve(b) for solve in libraries.solvers(matrix).values() if solve]
    assert len(solutions) >= 2
    for x in solutions:
        np.testing.assert_allclose(matrix @ x, b, atol=1e-8)
    spot.each(loops.FACTOR)
    R = reduction(spot.whole.terms.layout)
    ours = spot.whole.solve(R @ (b / R.sum(axis=0)))
    np.testing.assert_allclose(R.T @ ours / R.sum(axis=0), solutions[0], rtol=1e-8)


def test_absent_library_is_a_row(monkeypatch):
    def absent(matrix):
        raise ImportError("qdldl")

    monkeypatch.setitem(libraries.LIBRARIES, "QDLDL (qdldl)", absent)
    table = libraries.table((2,), 1)
    assert table.texts["QDLDL (qdldl)", 2] == "not installed"
    assert np.isfinite(table.values[libraries.OURS, 2])


def test_lanes_are_alike_and_wait_for_the_slowest():
    groups = list(lockstep.lanes(sweeps.thousand()))
    assert len(groups) >= 100
    for group in groups:
        assert len(group) == lockstep.LANES
        assert len({lockstep.topology(case) for case in group}) == 1
        assert len({case.case_id for case in group}) == lockstep.LANES
    one, other = (cases.crush(3, 0.6, 20, contact) for contact in (cases.SMOOTH, cases.ROUGH))
    assert lockstep.waiting([one, one]) == 1.0
    assert 1.0 < lockstep.waiting([one, other]) < 2.0


def test_sweep_with_a_failure_is_no_figure(monkeypatch):
    failing, simulating = cases.crush(2, 0.6, 3), import_module("sweep.simulation.simulate")
    usual = simulating.tolerances
    monkeypatch.setattr(simulating, "tolerances", lambda *of: usual(*of)._replace(iterations=0))
    with pytest.raises(RuntimeError, match="did not converge"):
        sweeps.swept([failing], 1)


def test_long_crush_says_when_it_has_packed(monkeypatch):
    monkeypatch.setattr(densify, "alone", lambda case: simulate(case).summary | {alone.MEMORY: 1.0})
    table = densify.table(2, 0.75, 30)
    assert full(table, ["to 75 % in 30 steps"])
    monkeypatch.setattr(densify, "alone", lambda case: {"status": "stopped", "message": "why"})
    assert densify.table(2, 0.75, 30).texts["to 75 % in 30 steps", "CPU s"] == "why"


def test_figure_draws_what_is_there():
    grown, factored = Table("", (3, 20, "power")), Table("", (3, 20))
    split, seed = Table("", ("3 x 3 buckled",)), Table("seed", scenes.COLUMNS)
    grown.put(growth.EACH, 3, 5.0), grown.put(growth.EACH, 20, 200.0)
    grown.put(growth.EACH, "power", 2.0)
    factored.put(libraries.OURS, 3, 2.0), factored.put(libraries.OURS, 20, 90.0)
    for name, value in ((iteration.WHOLE, 5.0), ("factor", 2.0), ("solve", 3.0)):
        split.put(name, "3 x 3 buckled", value)
    seed.put(scenes.SEED, scenes.WHOLE, 0.05)
    drawn = figure.draw(grown, factored, split, seed)
    left, middle, right = drawn.axes
    assert [list(line.get_ydata()) for line in left.lines] == [[5.0, 200.0], [2.0, 90.0]]
    assert [bar.get_width() for bar in middle.patches] == [40.0, 60.0]
    (points,) = right.collections
    assert points.get_offsets().tolist() == [[0.05, 0.0]]


def test_readme_shows_rows_of_the_bench():
    said = {row[0] for table in readme.tables() for row in table}
    chosen = {scenes.SEED, *scenes.ALLOWED, growth.EACH, growth.PEAK, "with friction"}
    assert chosen | {libraries.OURS} <= said
    absent = [name.split()[0] for name in libraries.LIBRARIES if name not in said]
    assert len(absent) < len(libraries.LIBRARIES)
    were = "was" if len(absent) == 1 else "were"
    assert not absent or readme.says(f"{' and '.join(absent)} {were} not installed")
