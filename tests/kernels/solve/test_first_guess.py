"""Where the descent of a step sets out, and with which factor."""

import numpy as np
import pytest

from kernels.terms import friction
from kernels.solve import march
from kernels.solve.workspace import make_room
from kernels.planar.potential import find_near
from sweep.scene.terms import build_scene
from tests.bench import cases, counts
from tests.bench.crushes import Crush
from tests.solving import at_rest, ramp

STEP = 1e-4  # m


@pytest.fixture
def guess():
    """The move with which a static step sets out after one of ``move`` m by a node."""
    scene = build_scene(cases.crush(2, 0.1, 10))
    terms, unknowns, state = scene.terms, scene.unknowns, at_rest(scene)
    near = find_near(state.x, terms, friction.none(), 0.0)
    room, progress = make_room(terms, near), np.zeros(1, march.PROGRESS)[0]
    progress.share = 1.0

    def set_out(move, last=STEP):
        room.at.u[:], room.at.u[unknowns.driven], room.at.u[0] = 0.0, -last, move
        stage = ramp(scene, 1, travel=(0.0, STEP))
        march._set_out(terms, stage, unknowns, state, near, room, progress)
        return room.work.dx.copy(), room.at.u.copy(), unknowns

    return set_out


def test_a_step_sets_out_as_the_last_one_went(guess):
    for last in (STEP, 2.0 * STEP):
        dx, u, unknowns = guess(1e-5, last)
        np.testing.assert_allclose(dx, u * STEP / last, rtol=1e-12)
        assert dx[unknowns.driven] == pytest.approx(-STEP, rel=1e-12)
    assert not np.any(guess(1e-5, 0.1 * STEP)[0])  # too short to tell


def test_no_step_sets_out_as_a_snap_went(guess):
    cap = guess(0.0)[2].cap
    assert np.any(guess(0.999 * cap)[0])
    assert not np.any(guess(1.001 * cap)[0])
    assert np.any(guess(1.5 * cap, 2.0 * STEP)[0])  # half of it is asked for


def test_a_factor_outlives_the_list_of_pairs():
    crush = Crush(3, cases.SMOOTH, (0.0, 0.1), 10)
    calls, iterations = counts.counted(crush), crush.onwards()[0].iterations
    assert calls["list"] * iterations == pytest.approx(crush.steps + 1)
    assert calls["factor"] < 1.0
