"""Stages of loading, and the criteria of convergence."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.kinds.steps import count_of
from sweep.scene.lattice import build_scene
from sweep.scene.loading import CycleRows, Phase, cycle_rows, stages, tolerances
from sweep.scene.scene import friction_of
from tests.support.designs.cases import pressed


@pytest.mark.parametrize(
    ("loading", "step", "phases"),
    [
        (dict(force=1.0, release_time=20e-3, duration=40e-3), 15e-3, [(2, 10e-3)] * 2),
        (dict(force=1.0, release_time=20e-3, duration=40e-3), 10e-3, [(2, 10e-3)] * 2),
        (dict(mode="impact", duration=10e-3), 6e-3, [(2, 5e-3)]),
    ],
)
def test_steps_fill_the_time_until_release_and_after(loading, step, phases):
    case = Case.of(loading=loading, solver=dict(time_step=step))
    made = [phase.stage for phase in stages(case, build_scene(case))]
    assert [(stage.steps, stage.duration) for stage in made] == phases


def ends(case):
    """Load factor and driven coordinate at the ends of every stage."""
    scene = build_scene(case)
    found = [phase.stage for phase in stages(case, scene)]
    rest = scene.x_rest[-1]
    return [(s.factor0, s.factor1, s.driven0 - rest, s.driven1 - rest) for s in found]


@pytest.mark.parametrize("unload", [True, False])
def test_a_platen_goes_down_and_back_if_it_is_let_up(unload):
    loading = dict(mode="displacement", stroke=4e-3, unload=unload)
    case = Case.of(loading=loading, solver=dict(load_steps=7))
    there, back = (0.0, 0.0, 0.0, -4e-3), (0.0, 0.0, -4e-3, 0.0)
    assert np.array(ends(case)) == pytest.approx(np.array([there, back][: 1 + unload]))
    assert all(phase.stage.steps == 7 for phase in stages(case, build_scene(case)))


def test_a_crush_is_repeated():
    loading = dict(mode="displacement", stroke=4e-3, cycles=3)
    case = Case.of(loading=loading, solver=dict(load_steps=7))
    assert ends(case) == ends(pressed(stroke=4e-3)) * 3
    phases = stages(case, build_scene(case))
    assert [phase.name for phase in phases[:3]] == ["loading", "unloading", "loading in cycle 2"]
    assert count_of(case.loading, case.solver) == sum(phase.stage.steps for phase in phases) == 42


def test_a_load_moves_the_free_mass_by_the_height_in_the_time_of_a_fall():
    """A constant force accelerates it; other integrators and loadings do not use this time."""
    case = Case.of(loading=dict(force=30.0), solver=dict(integrator="backward_euler"))
    scene = build_scene(case)
    y_masses = scene.terms.coordinates.mass[1 : 2 * scene.terms.layout.n_nodes : 2]
    for phase in stages(case, scene):
        gone = 0.5 * 30.0 / y_masses.sum() * phase.stage.fall**2
        assert gone == pytest.approx(case.height)
    for other in (case.changed(solver=dict(integrator="newmark")), pressed(stroke=4e-3)):
        assert {phase.stage.fall for phase in stages(other, build_scene(other))} == {np.inf}


def test_a_dead_load_is_on_until_its_release():
    loading = dict(force=1.0, release_time=20e-3, duration=30e-3)
    case = Case.of(loading=loading, solver=dict(time_step=10e-3))
    assert ends(case) == [(1.0, 1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)]
    assert cycle_rows(stages(case, build_scene(case))) == [(0, 2, 2, 3)]
    assert ends(case.changed(loading={"release_time": 30e-3})) == [(1.0, 1.0, 0.0, 0.0)]


@pytest.mark.parametrize(
    ("loading", "rows"),
    [
        (dict(mode="displacement"), [(0, 7, 7, 14)]),
        (dict(mode="displacement", unload=False), [(0, 7, 7, 7)]),
        (dict(mode="displacement", cycles=2), [(0, 7, 7, 14), (14, 21, 21, 28)]),
        (dict(mode="displacement", hold_time=9.0), [(0, 7, 14, 21)]),
        (dict(mode="displacement", hold_time=9.0, unload=False), [(0, 7, 14, 14)]),
        (dict(strain=0.56, speed=1.0, hold_time=3.5e-3), [(0, 7, 11, 18)]),
    ],
)
def test_rows_at_which_a_crush_turns(loading, rows):
    case = Case.of(material=dict(loss=0.3), loading=loading, solver=dict(load_steps=7))
    assert cycle_rows(stages(case, build_scene(case))) == rows
    assert count_of(case.loading, case.solver) == rows[-1][-1]


def test_a_pause_lasts_as_long_as_it_is_given():
    loading = dict(strain=0.56, speed=1.0, hold_time=3.5e-3)
    case = Case.of(loading=loading, solver=dict(load_steps=7))
    (_, pause, _) = stages(case, build_scene(case))
    assert (pause.name, pause.role, pause.stage.dynamic) == ("holding", "hold", True)
    assert pause.stage.steps * pause.stage.duration == pytest.approx(3.5e-3)
    assert pause.stage.driven0 == pause.stage.driven1


def test_a_cycle_of_many_phases_is_loaded_until_the_last_loading():
    """Five, then four steps down; three at rest; twice two steps up."""
    case = pressed()
    stage = stages(case, build_scene(case))[0].stage
    phases = [
        Phase(role, stage._replace(steps=steps), role)
        for role, steps in [("loading", 5), ("loading", 4), ("hold", 3), *[("unloading", 2)] * 2]
    ]
    again = [phase._replace(cycle=2) for phase in phases]
    assert cycle_rows(phases + again) == [CycleRows(0, 9, 12, 16), CycleRows(16, 25, 28, 32)]


def test_the_tolerance_goes_with_the_load_and_not_below_round_off():
    def allowed(force, tolerance):
        case = Case.of(
            lattice=dict(nodes_per_wall=2),
            loading=dict(force=force),
            solver=dict(tolerance=tolerance, joints="points"),
        )
        scene = build_scene(case)
        return tolerances(case, scene, stages(case, scene)[0].stage)

    nodes = 10  # of the row that bears the load
    assert allowed(4e3, 1e-6).force == pytest.approx(4e3 / nodes * 1e-6)
    assert allowed(4e3, 1e-6).decrement == pytest.approx(1e-3 * 4e-4 * 0.8e-3)
    assert allowed(4e3, 1e-30).force == allowed(4e3, 1e-40).force > 0.0


@pytest.mark.parametrize(
    ("loading", "share"),
    [({"mode": "displacement"}, 1e-6), ({"mode": "displacement", "speed": 1.0}, 0.0), ({}, 0.0)],
)
def test_the_residual_may_grow_with_the_forces_of_a_crush_not_of_a_motion(loading, share):
    case = Case.of(loading=loading)
    scene = build_scene(case)
    assert tolerances(case, scene, stages(case, scene)[0].stage).share == pytest.approx(share)


def test_walls_that_relax_have_shorter_steps_where_they_buckle():
    """A step is as short as a 32nd of a load step, and as long as four of them, as of others; a
    pause has its own steps. The slip in all steps together is the same. An unloading is allowed
    three times the error.
    """
    for loss, rows, eased in ((None, 1, 1.0), (0.3, 32, 3.0)):
        tables = {} if loss is None else dict(material=dict(loss=loss))
        loading = dict(mode="displacement", strain_rate=0.1, hold_time=1.0)
        case = Case.of(loading=loading, **tables)
        down, *pause, up = (phase.stage for phase in stages(case, build_scene(case)))
        assert down.steps == up.steps == 400 * rows
        assert down.longest == up.longest == 4 * rows
        assert down.relaxes == up.relaxes == (loss is not None)
        assert (down.accuracy, up.accuracy) == (1e-3, eased * 1e-3)
        assert friction_of(case).slip * down.steps == pytest.approx(0.2 * 0.8e-3)
        assert [(still.accuracy, still.longest, still.relaxes) for still in pause] == (
            [(np.inf, 1, False)] if loss else []
        )
