"""Error bars: the companions of a design, their results, and that nothing runs twice."""

import math
from dataclasses import replace

import pytest

from sweep.config.case import Case
from sweep.config.grid import Config, Recipe, Written, expand, expanded
from sweep.ranking.rank import rank
from sweep.result import Status
from sweep.running.batches import cost
from sweep.running.beside.error_bars import add_error_bars, companions, error_bars
from sweep.running.beside.run_beside import How, file_beside
from sweep.running.sweep import run_sweep
from sweep.simulation.simulate import simulate as crush
from sweep.store.read import Rerun, read_attributes, read_summary
from tests.support.results.standin import Logged, make_older, simulate

ENERGY, BAR = "absorbed_energy_J", "error_absorbed_energy_J"
PRESSED = dict(mode="displacement", strain=0.3)


def first_order(case, control=None):
    """5 J, plus errors of elements and steps of first order."""
    element, step = 1.0 / (case.lattice.nodes_per_wall + 1), 1.0 / case.solver.load_steps
    result = simulate(case)
    measured = {ENERGY: 5.0 + 3.0 * element + 20.0 * step, "peak_strain": 0.3}
    return replace(result, summary=result.summary | measured)


def config(**axes):
    """A sweep of crushes in 40 steps; "__" stands for the dot of a key."""
    base = {"lattice.nodes_per_wall": 2, "loading.mode": "displacement", "solver.load_steps": 40}
    axes = axes or {"lattice__imperfection": (0.001, 0.002)}
    recipe = Recipe(
        base={key: Written(value, str(value)) for key, value in base.items()},
        grid={
            key.replace("__", "."): tuple(Written(value, str(value)) for value in values)
            for key, values in axes.items()
        },
    )
    return Config("trial", expanded(recipe)[0], recipe=recipe)


@pytest.fixture
def out(tmp_path):
    return tmp_path / "trial.h5"


@pytest.fixture
def logged():
    return Logged(first_order)


def without_coarse_meshes(case, control):
    """`first_order`, but one element a wall stops where the imperfection is 0.002."""
    fails = case.lattice.nodes_per_wall == 0 and case.lattice.imperfection == 0.002
    return (stopped if fails else first_order)(case)


@pytest.mark.parametrize(
    ("pieces", "other", "weight"),
    [(1, 2, 2.0), (2, 1, 1.0), (3, 1, 0.5), (4, 2, 1.0), (6, 3, 1.0), (7, 3, 0.75)],
)
def test_other_mesh_is_half_as_fine_or_twice_where_there_is_no_half(pieces, other, weight):
    def pressed(elements):
        return Case.of(lattice=dict(nodes_per_wall=elements - 1), loading=PRESSED)

    mesh, _ = companions(pressed(pieces))
    assert mesh.case.case_id == pressed(other).case_id
    assert mesh.weight == pytest.approx(weight)


@pytest.mark.parametrize(
    ("design", "solver", "weight"),
    [
        ({}, {"load_steps": 200, "accuracy": 2e-3}, 1.0),
        ({"load_steps": 5}, {"load_steps": 2}, 2 / 3),
        ({"load_steps": 1}, {"load_steps": 2}, 2.0),
        ({"time_step": 1e-4}, {"time_step": 2e-4}, 1.0),
        (
            {"integrator": "backward_euler", "step_error": 1e-6},
            {"time_step": 2e-4, "step_error": 4e-6},
            1.0,
        ),
        ({"integrator": "bdf2", "step_error": 1e-6}, {"time_step": 2e-4, "step_error": 8e-6}, 1.0),
    ],
)
def test_longer_steps_are_all_that_differs(design, solver, weight):
    crushed = not {"time_step", "integrator"} & {*design}
    design = Case.of(loading=PRESSED if crushed else {}, solver=design)
    _, steps = companions(design)
    expected = design.model_copy(update={"solver": design.solver.model_copy(update=solver)})
    assert steps.case.case_id == expected.case_id != design.case_id
    assert steps.weight == pytest.approx(weight)


def test_longer_steps_of_a_platen_at_a_speed_are_those_of_a_config():
    def moving(steps):
        loading = dict(mode="displacement", strain=0.3, speed=0.1)
        return Case.of(loading=loading, solver=dict(load_steps=steps))

    _, steps = companions(moving(50))
    assert steps.case.case_id == moving(25).case_id


@pytest.mark.parametrize("mode", ["displacement", "force", "impact"])
def test_companions_take_less_work_than_the_design(mode):
    """The sweep with its error bars is at most three times the work of the sweep alone."""
    loading = dict(mode=mode) if mode != "impact" else dict(energy=0.1, striker_mass=0.05)
    design = Case.of(loading=loading)
    work = [cost(c.case) for c in companions(design)]
    assert sum(work) < 2.0 * cost(design)


def test_estimate_is_exact_at_first_order():
    """Two errors, 3 J / 3 and 20 J / 40, each from the difference of a pair: Richardson by hand.

    The other column, the peak strain, does not change, and so does not raise these errors.
    """
    design, *_ = expand(config())
    bars = error_bars(design, measured(design, first_order))
    assert bars[BAR] == pytest.approx(3.0 / 3 + 20.0 / 40)
    assert bars["error_peak_strain"] == 0.0
    assert "error_min_gap_m" not in bars
    assert "error_absorbed_energy_at_50N_J" in bars


def test_correction_is_exact_at_second_order_in_the_mesh():
    def second_order(case):
        element = 1.0 / (case.lattice.nodes_per_wall + 1)
        result = simulate(case)
        return replace(result, summary=result.summary | {ENERGY: 5.0 + 3.0 * element**2})

    design, *_ = expand(config())
    rows = measured(design, second_order)
    correction = error_bars(design, rows)["correction_absorbed_energy_J"]
    assert correction == pytest.approx(5.0 - rows[design.case_id][ENERGY])


def test_column_that_agrees_by_chance_has_the_error_of_the_others():
    """Three columns change by 20, 20 and 40 % of their value, the energy does not change."""
    own = {"peak_force_N": 10.0, "packing_strain": 0.5, "efficiency": 0.1, ENERGY: 5.0}
    coarse = {"peak_force_N": 8.0, "packing_strain": 0.6, "efficiency": 0.14, ENERGY: 5.0}
    bars, mesh = coarsened(own, coarse)
    assert bars[BAR] == pytest.approx(mesh.weight * 0.2 * 5.0)
    assert bars["error_peak_force_N"] == pytest.approx(mesh.weight * math.hypot(2.0, 2.0))
    assert bars["correction_absorbed_energy_J"] == 0.0
    assert bars["correction_peak_force_N"] == pytest.approx(2.0 * mesh.correction)


def test_what_follows_from_other_columns_has_a_bar_and_no_part_in_the_others():
    """With 40 and 80 % for the columns of losses and cycles, the energy still has 20 %."""
    following = dict.fromkeys(("lost_energy_J", "lost_share", "absorbed_energy_in_cycle_2_J"), 1.0)
    own = {"peak_force_N": 10.0, ENERGY: 5.0} | following
    coarse = {"peak_force_N": 8.0, ENERGY: 4.0} | dict.fromkeys(following, 1.6)
    bars, mesh = coarsened(own, coarse)
    assert bars[BAR] == pytest.approx(mesh.weight * math.hypot(1.0, 1.0))
    for name in following:
        assert bars[f"error_{name}"] == pytest.approx(mesh.weight * math.hypot(0.6, 0.2))


def test_companion_that_is_a_design_of_this_or_an_earlier_sweep_runs_once(out, logged):
    sweep = config(lattice__nodes_per_wall=(2, 5))
    run_sweep(sweep, out, simulate=logged)
    add_error_bars(config(lattice__nodes_per_wall=(5,)), out, How(simulate=logged))
    assert len(logged) == len(set(logged)) == 3  # three and six elements; six in 20 steps
    summary = read_summary(out).set_index("lattice.nodes_per_wall")
    assert summary[BAR].notna().to_dict() == {2: False, 5: True}
    add_error_bars(sweep, out, How(simulate=logged))
    assert len(logged) == len(set(logged)) == 5  # and one element, three in 20 steps
    assert list(read_summary(out)[BAR]) == pytest.approx([1.0 + 0.5, 0.5 + 0.5])


def test_error_bars_are_added_to_what_is_there_and_nothing_runs_twice(out, logged, capsys):
    ids = [case.case_id for case in expand(config())]
    assert run_sweep(config(), out, simulate=logged) == 0
    assert BAR not in read_summary(out)
    assert sorted(logged) == sorted(ids)

    written = set()
    for run in (add_error_bars, add_error_bars, run_sweep):
        how = {"simulate": logged} if run is run_sweep else {"how": How(simulate=logged)}
        assert run(config(), out, **how) == 0
        assert len(logged) == len(set(logged)) == 6
        summary = read_summary(out)
        assert list(summary["case_id"]) == ids
        assert list(summary[BAR]) == pytest.approx([1.5, 1.5])
        written.add(out.stat().st_mtime_ns)
    assert len(written) == 1
    assert "error bars of 2 designs: 4 companions, in" in capsys.readouterr().err
    assert list(summary["lattice.imperfection"]) == [0.001, 0.002]
    assert set(read_summary(file_beside(out, "companions"))["case_id"]) == set(logged[2:])
    assert '"name": "trial"' in read_attributes(out)["config"]


def test_failed_companion_leaves_the_design_without_a_bar_and_is_told(out, capsys):
    run_sweep(config(), out, simulate=without_coarse_meshes)
    assert add_error_bars(config(), out, How(simulate=without_coarse_meshes)) == 1
    told = capsys.readouterr().err
    beside = file_beside(out, "companions")
    assert f"1 of 2 designs have no error bar: crumple status {beside}" in told
    summary = read_summary(out)
    assert list(summary["status"]) == ["converged"] * 2
    assert summary[BAR].isna().tolist() == [False, True]
    assert len(rank(summary)) == 2

    run = first_order
    assert add_error_bars(config(), out, How(simulate=run)) == 1
    assert add_error_bars(config(), out, How(rerun=Rerun(failed=True), simulate=run)) == 0
    assert list(read_summary(out)[BAR]) == pytest.approx([1.5, 1.5])


def test_error_bars_are_never_of_two_models(out):
    run_sweep(config(), out, simulate=first_order)
    assert add_error_bars(config(), out, How(simulate=first_order)) == 0
    make_older(file_beside(out, "companions"))
    assert add_error_bars(config(), out, How(simulate=first_order)) == 2
    assert read_summary(out)[BAR].isna().all()
    assert add_error_bars(config(), out, How(rerun=Rerun(older=True), simulate=first_order)) == 0
    assert list(read_summary(out)[BAR]) == pytest.approx([1.5, 1.5])


def test_renewed_companions_are_no_older_rows_of_another_sweep(out):
    run_sweep(config(lattice__nodes_per_wall=(2, 5)), out, simulate=first_order)
    make_older(out)
    sweep, renew = config(lattice__nodes_per_wall=(2,)), Rerun(older=True)
    run_sweep(sweep, out, rerun=renew, simulate=first_order)
    assert add_error_bars(sweep, out, How(rerun=renew, simulate=first_order)) == 0
    assert add_error_bars(sweep, out, How(simulate=first_order)) == 0


def test_failed_design_has_no_companions(out, logged):
    sweep = config(lattice__imperfection=(0.001,))
    run_sweep(sweep, out, simulate=stopped)
    assert add_error_bars(sweep, out, How(simulate=logged)) == 0
    assert logged == []
    assert BAR not in read_summary(out)


def test_error_bar_covers_the_error_of_a_crush():
    """A part of the study `make bars`: four cells pressed to half their height."""
    cells = {"cells_x": 2, "cells_y": 2, "wall_thickness": 0.5e-3}
    loading = dict(mode="displacement", strain=0.5)
    design = Case.of(lattice=cells, loading=loading, solver=dict(load_steps=50))
    fine = dict(**cells, nodes_per_wall=11)
    reference = crush(Case.of(lattice=fine, loading=loading, solver=dict(load_steps=200))).summary
    rows = measured(design, crush)
    for name in (ENERGY, "plateau_stress_Pa", "peak_force_N", "absorbed_energy_until_packed_J"):
        error = abs(rows[design.case_id][name] - reference[name])
        bar = error_bars(design, rows)[f"error_{name}"]
        assert 0.0 < error <= bar < 0.25 * rows[design.case_id][name], name


def measured(design, simulate):
    """The rows of a design and of its companions, by their ids."""
    cases = [design, *(companion.case for companion in companions(design))]
    return {case.case_id: simulate(case).summary for case in cases}


def coarsened(own, coarse):
    """Error bars of a design whose coarser mesh alone has other values; the coarser mesh."""
    design, *_ = expand(config())
    mesh, steps = companions(design)
    rows = {design.case_id: own, steps.case.case_id: own, mesh.case.case_id: coarse}
    return error_bars(design, {key: row | {"model_version": 1} for key, row in rows.items()}), mesh


def test_peak_force_under_a_load_that_is_put_on_at_once_has_no_error_bar():
    bars = error_bars(Case.of(), measured(Case.of(), simulate))
    assert math.isnan(bars["error_peak_force_N"])
    assert bars[BAR] == 0.0


def stopped(case, control=None):
    """A case that stops while loading."""
    result = first_order(case)
    summary = {**result.summary, "loaded": 0}
    return replace(result, status=Status.STOPPED, message="No.", summary=summary)
