"""The inside of a step as tests reach it: the one place that knows how its kernels are called."""

from types import SimpleNamespace
from typing import NamedTuple
from unittest.mock import patch

import numpy as np

from kernels import friction, march, newton, step
from sweep.scene import build_scene
from sweep.simulate import tolerances
from tests.terms import dense

RUN = np.zeros(2, dtype=np.int64)  # nobody asks to stop


def _hessian(x, terms, one, near, matrix, projected):
    step.hessian(x, terms, one, near._replace(matrix=matrix), projected)


WHOLE = SimpleNamespace(energy=step.energy, gradient=step.gradient, hessian=_hessian)
"""The sum of all terms, in the form of one term; its arguments: `whole`."""


def whole(scene, x, x0=None, dt=np.inf, v=None, factor=1.0):
    """Terms, step and pairs near ``x`` of a step from x0 (``x``) and v (0); friction lags at x."""
    x0 = x if x0 is None else x0
    x_pred = x0 if v is None else x0 + dt * v
    near = step.find_near(x, scene.terms, 0.0)
    grips = friction.lag(x, scene.terms.contact, near.pairs, scene.terms.friction)
    return scene.terms, step.Step(x0.copy(), x_pred.copy(), dt, factor, grips), near


def reduction(scene):
    """Matrix (n, rows) from the rows that are solved for to coordinates."""
    row = scene.unknowns.row
    return (row[:, None] == np.arange(row.max() + 1)).astype(float)


def assembled(x, args, projected=False):
    """Hessian (rows, rows) as a step assembles it in the room that it has made."""
    step.hessian(x, *args, projected)
    return dense(args[2].matrix)


def limit(scene, x, dx):
    """Share of the move ``dx`` from ``x`` that is admissible."""
    near = step.find_near(x, scene.terms, float(np.abs(dx).max()))
    return step.step_limit(x, dx, scene.terms, near)


def residual(scene, x, args):
    """Forces (rows,) out of balance in N, the driven one left out."""
    g = np.zeros_like(x)
    step.gradient(x, *args, g)
    free = scene.unknowns.free
    return (reduction(scene).T @ g)[:free] / scene.unknowns.scale[:free]


class Descent(NamedTuple):
    """How a minimisation ended, and where."""

    outcome: int
    iterations: int
    x: np.ndarray


def descend(case, scene, start, args, target=None, control=RUN, **tolerance):
    """Minimise from ``start`` with the platen at ``target`` (where it is)."""
    terms, one, _ = args
    x = start.copy()
    rows = scene.unknowns.scale.size
    outcome, iterations, _ = newton.minimise(
        x, x[-1] if target is None else target, terms, one, step.find_near(x, terms, 0.0),
        scene.unknowns, tolerances(case, scene, one.dt)._replace(**tolerance),
        newton.Work(*np.zeros((3, x.size)), *np.zeros((3, rows))), control,
    )  # fmt: skip
    return Descent(outcome, iterations, x)


def at_rest(scene):
    """State of a march that begins."""
    n = scene.x_rest.size
    return march.State(
        scene.x_rest.copy(), np.zeros(n), np.zeros(march.TIME), np.zeros(n), np.zeros(n),
        np.zeros(2), np.zeros(3),
    )  # fmt: skip


def ramp(scene, steps, dt=np.inf, factor=(0.0, 0.0), travel=(0.0, 0.0)):
    """Stage in which the load factor and the platen's way down (m) go from one value to another."""
    high = scene.x_rest[-1]
    pace = dt if np.isfinite(dt) else 1.0
    return march.Stage(steps, dt, pace, *factor, high - travel[0], high - travel[1])


def go_on(case, scene, state, stage, control=RUN, **tolerance):
    """March ``state`` through a stage; return the outcome and the rows written."""
    out = march.Output(
        np.zeros((stage.steps, march.N_COLUMNS)), np.full(stage.steps, -1),
        np.zeros((0, state.x.size)), scene.bottom, scene.top, scene.base,
    )  # fmt: skip
    allowed = tolerances(case, scene, stage.dt)._replace(**tolerance)
    outcome, written = march.march(scene.terms, scene.unknowns, allowed, stage, state, out, control)
    return outcome, out.rows[:written]


def floating(case):
    """The scene of a case without its supports: only the platens are held."""
    with patch("sweep.scene.held", lambda layout, _: np.array([layout.low, layout.high])):
        return build_scene(case)
