"""Where the descent of a step sets out, and with which factor."""

from collections import Counter
from unittest.mock import patch

import numpy as np
import pytest

from kernels.compile.jit import Kernel
from kernels.compile.reference import by_reference
from kernels.planar import neighbour_lists
from kernels.planar.problem import Planar
from kernels.shared.rows import STORED
from kernels.solve import march, newton
from kernels.solve.workspace import make_workspace
from sweep.scene import loading
from sweep.scene.lattice import build_scene
from tests.studies.bench.measuring import cases
from tests.studies.bench.measuring.crushes import Crush
from tests.support.kernels.solving import at_rest, ramp, whole

WATCHED = {Planar.factor: "factor", neighbour_lists.list_neighbours: "list"}
COMPILED = (Planar.descend,)  # meets records that only compiled code can read


def counted(crush):
    """Calls an iteration of every part while a crush goes on."""
    calls, compiled = Counter(), Kernel.__call__

    def call(kernel, *args):
        if kernel not in WATCHED:
            return compiled(kernel, *args) if kernel in COMPILED else kernel.__wrapped__(*args)
        calls[WATCHED[kernel]] += 1
        return compiled(kernel, *args)

    with patch.object(Kernel, "__call__", call):
        spent, _ = crush.onwards()
    return {part: calls[part] / spent.iterations for part in WATCHED.values()}


STEP = 1e-4  # m


@pytest.fixture
def guess():
    """The move with which a static step sets out after one of ``move`` m by a node."""
    case = cases.crush(2, 0.1, 10)
    scene = build_scene(case)
    state, problem = at_rest(scene), whole(scene, scene.x_rest).problem
    workspace, driven = make_workspace(state.x.size, STORED), scene.terms.coordinates.driven
    progress, descent = np.zeros(1, march.PROGRESS)[0], np.zeros(1, newton.DESCENT)[0]
    progress.share = 1.0

    def set_out(move, last=STEP):
        u = workspace.evaluation.u
        u[:], u[driven], u[0] = 0.0, -last, move
        stage = ramp(scene, 1, travel=(0.0, STEP))
        state_, workspace_ = by_reference(state), by_reference(workspace)
        allowed = loading.tolerances(case, scene, stage)
        march._begin_share(problem, allowed, stage, state_, workspace_, descent, progress)
        return workspace.work.dx.copy(), u.copy(), scene.terms.coordinates

    return set_out


def test_a_step_sets_out_as_the_last_one_went(guess):
    for last in (STEP, 2.0 * STEP):
        dx, u, coordinates = guess(1e-5, last)
        np.testing.assert_allclose(dx, u * STEP / last, rtol=1e-12)
        assert dx[coordinates.driven] == pytest.approx(-STEP, rel=1e-12)
    assert not np.any(guess(1e-5, 0.1 * STEP)[0])  # too short to tell


def test_no_step_sets_out_as_a_snap_went(guess):
    cap = guess(0.0)[2].cap
    assert np.any(guess(0.999 * cap)[0])
    assert not np.any(guess(1.001 * cap)[0])
    assert np.any(guess(1.5 * cap, 2.0 * STEP)[0])  # half of it is asked for


def test_a_factor_outlives_the_list_of_pairs(monkeypatch):
    monkeypatch.setattr(loading, "LOADED", 0.0)  # so that last moves are short
    crush = Crush(3, cases.SMOOTH, (0.0, 0.1), 40)
    calls, iterations = counted(crush), crush.onwards()[0].iterations
    assert 1.0 < calls["list"] * iterations < crush.steps + 1.5
    assert calls["factor"] < 1.0
