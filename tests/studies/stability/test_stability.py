"""Scenes of `configs/extreme.toml` under observation: does the observer see violations?"""

from functools import partial
from unittest.mock import patch

import numpy as np
import pytest

from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.scene.custom import build_structure
from sweep.simulation.warm_up import warm_up
from tests.studies.stability import audit, draw, model, structures
from tests.studies.stability.__main__ import counted, has_no_answer, markdown, outcome
from tests.studies.stability.structures import IN_TIME
from tests.support.designs.scenes import pressed, run
from tests.support.kernels.solving import at_rest, ramp, whole
from tests.support.kernels.states import STATES, driven, loaded

FEW, SOLVED = 33, 12
ENDS = "converged", "unresolved"  # impacts in far too long steps of backward Euler


@pytest.fixture(scope="module")
def drawn():
    warm_up()  # no scene waits for a compiler
    return [draw.scene(number)[1] for number in range(FEW)]


def test_the_config_holds_the_scenes_that_are_drawn(drawn):
    assert (draw.CONFIGS / "extreme.toml").read_text("utf-8") == draw.toml(draw.COUNT)
    cases = expand(load_config(draw.CONFIGS / "extreme.toml"))
    assert len(cases) == draw.COUNT
    assert [case.case_id for case in cases[:FEW]] == [case.case_id for case in drawn]


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize(
    "build", [loaded, partial(loaded, 1), partial(driven, "glued")], ids=["3", "1", "driven"]
)
def test_the_second_model_agrees_with_the_kernels(build, state):
    scene = build()
    x = STATES[state](scene)
    _, at = whole(scene, x, dt=np.inf).found(x)
    second = model.stored(x, scene.terms)
    np.testing.assert_allclose(second.energy, at.stored, rtol=1e-11)
    np.testing.assert_allclose(second.gradient, at.elastic, atol=1e-13 * second.scale)


@pytest.mark.parametrize("turn", [-3.3, 3.3])
def test_both_models_follow_a_node_that_turns_by_more_than_half(turn):
    scene = loaded()
    x0 = scene.x_rest
    x = x0.copy()
    walls = scene.terms.walls
    x[walls.dofs[len(walls.dofs) // 2, 2]] += turn
    _, at = whole(scene, x, x0).found(x)
    second = model.stored(x, scene.terms)
    np.testing.assert_allclose(second.energy, at.stored, rtol=1e-11)
    np.testing.assert_allclose(second.gradient, at.elastic, atol=1e-13 * second.scale)


def test_light_scenes_violate_nothing(drawn):
    light = [
        case.changed(solver={"retry": False})
        for case in drawn
        if case.lattice.counts[1] * (case.lattice.nodes_per_wall + 1) < 200
    ]
    audits = [audit.audit(case) for case in light]
    assert [found.violations for found in audits] == [()] * len(light)
    assert sum(found.status in ENDS for found in audits) == SOLVED
    assert sum(found.balanced for found in audits) > len(light)


def corner(case, cells_x, cells_y):
    """The same scene of fewer cells, with their share of the striker."""
    lattice, loading = case.lattice, case.loading
    share = cells_x / lattice.cells_x, cells_y / lattice.cells_y
    size = {"width": share[0] * lattice.width, "height": share[1] * lattice.height}
    cells = {"cells_x": cells_x, "cells_y": cells_y}
    mass = {"striker_mass": share[0] * share[1] * loading.striker_mass}
    return case.model_copy(
        update={
            "lattice": lattice.model_copy(update=cells | size),
            "loading": loading.model_copy(update=mass),
        }
    )


@pytest.mark.parametrize(
    "case",
    [corner(draw.scene(40)[1], 8, 1), draw.scene(51)[1], draw.remembering(105)],
    ids=["struck", "rough", "released"],
)
def test_no_force_is_left_over_where_stiffnesses_differ_by_far(case):
    """A soft coordinate was not balanced next to a stiff one, nor friction at the end of a step."""
    warm_up()
    solver = case.solver.model_copy(update={"retry": False})
    seen = audit.audit(case.model_copy(update={"solver": solver}))
    assert seen.violations == ()
    assert seen.balanced > 0


def between_points(case):
    """The same scene with joints that are points; with solid ones, friction does not settle."""
    return case.model_copy(update={"solver": case.solver.model_copy(update={"joints": "points"})})


EXTREMES = {
    "far too long steps": draw.scene(463)[1],
    "folded beyond resolution": between_points(corner(draw.scene(55)[1], 3, 5)),
}


@pytest.mark.parametrize("case", EXTREMES.values(), ids=EXTREMES)
def test_backward_euler_makes_no_energy(case):
    warm_up()
    found = audit.audit(case)
    assert found.status in ENDS or "speed of sound" in found.message
    assert found.violations == ()


def test_a_load_that_moves_nothing_is_a_failure():
    """45 nN for half a microsecond: less than positions resolve."""
    found = audit.audit(draw.scene(389)[1])
    assert (found.status, found.violations) == ("stopped", ())
    assert "round-off" in found.message


STRUCTURES, MOVING = range(100, 160), 59
SECOND_ORDER = (6, 12, 15, 25, 29)


def test_custom_structures_violate_nothing():
    """All loadings and integrators; two structures once stood still under their load."""
    warm_up(["marches", "arcs"])  # none waits for a compiler
    cases = [structures.structure_scene(number) for number in STRUCTURES]
    assert {case.solver.integrator for case in cases} == {*IN_TIME, "static", "arc_length"}
    audits = [audit.audit(case) for case in cases]
    assert [found.violations for found in audits] == [()] * len(audits)
    assert [found.status for found in audits].count("converged") == MOVING
    assert sum(found.balanced for found in audits) > 0.7 * len(audits)


def test_lattices_that_move_by_schemes_of_second_order_violate_nothing():
    """Scene 15 is stopped, as its motion does not exceed round-off. Others run out of time where
    the machine is slow.
    """
    audits = [audit.audit(draw.second_order(number)) for number in SECOND_ORDER]
    assert [found.violations for found in audits] == [()] * len(audits)
    statuses = {number: found.status for number, found in zip(SECOND_ORDER, audits, strict=True)}
    assert statuses.pop(15) == "stopped"
    assert "converged" in statuses.values()
    assert set(statuses.values()) <= {*ENDS, "timed_out"}


def test_what_stands_still_under_its_load_is_seen():
    case = structures.structure_scene(121)
    scene = build_structure(case)
    state, stage = at_rest(scene), ramp(scene, 1, 1e-9, (1.0, 1.0))
    step, _ = audit._next_step(scene.terms, stage, state)
    (said,) = audit._unborne(scene.terms, state, step)
    assert "nothing moves under" in said
    assert list(audit._unborne(scene.terms, state, step._replace(factor=0.0))) == []
    state.x[3] += 1e-9
    assert list(audit._unborne(scene.terms, state, step)) == []


def test_what_is_wrong_is_seen():
    case = pressed(3, 0.5, 30, friction=0.3)
    assert audit.audit(case).violations == ()
    with patch.object(model, "GUARD", 0.5):
        assert "second model" in " ".join(audit.audit(case).violations)
    with patch("kernels.planar.problem.Planar.lag", lambda *_: True):
        assert "allowed residual" in " ".join(audit.audit(case).violations)


def test_arms_that_change_places_are_seen():
    result = run(pressed(3, 0.5, 30, friction=0.3))
    frames = dict(result.frames)
    assert audit._turned_over(frames["position_m"][-1], frames) == 0
    turned = frames["position_m"][0] * [-1.0, 1.0]
    assert audit._turned_over(turned, frames) > 0


def test_outcomes_are_counted(drawn):
    cases = drawn[:2]
    found = audit.Audit(
        "stopped", "no way while loading, at strain 0.1; try less", "", ("wrong",), 2, 0.1
    )  # fmt: skip
    table = counted(cases, [found, found._replace(status="converged", message="", violations=())])
    assert list(table) == [
        "converged",
        "stopped: no way",
        "have no answer, of these",
        "violated something",
        "steps balanced anew",
    ]
    assert [row["all"] for row in table.values()] == [1, 1, 0, 1, 4]
    assert markdown(table)[3].startswith("| stopped: no way | ")
    open_book = found._replace(message="work and energies do not balance at strain 1; try")
    again = found._replace(status="converged", retry="solver.time_step = 1 us")
    assert outcome(again) == "converged in a retry"
    assert outcome(open_book) == "stopped: work and energies do not balance"


def test_scenes_without_an_answer_are_counted_apart():
    """A load below round-off, and one that folds walls flat; not a load that they bear."""
    flat, borne = (draw.scene(number)[1] for number in (141, 146))
    assert flat.contact.model == borne.contact.model == "none"
    stopped = audit.Audit("stopped", "stopped: it stalled; try less", "", (), 1, 0.1)
    tiny = stopped._replace(message="for the motion to exceed round-off; try more")
    done = stopped._replace(status="converged", message="")
    pairs = [(flat, stopped), (borne, stopped), (borne, tiny), (flat, done)]
    assert [has_no_answer(*pair) for pair in pairs] == [True, False, True, False]
    last = markdown(counted(*zip(*pairs, strict=True)))[-2:]
    assert [row.split(" | ")[-1] for row in last] == ["25 |", "50 |"]


def test_a_striker_faster_than_sound_has_no_answer_where_it_fails():
    fast, slow = draw.scene(267)[1], draw.scene(264)[1]  # 110 and 0.003 times the speed of sound
    found = audit.Audit("timed_out", "over time", "", (), 0, 0.1)
    assert has_no_answer(fast, found)
    assert not has_no_answer(slow, found)
    assert not has_no_answer(fast, found._replace(status="converged"))
