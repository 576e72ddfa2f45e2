"""A small tube pressed along its cell by 40 %: properties of every step of the march."""

import numpy as np
import pytest

from kernels.geometry.space import crossing
from kernels.shared.rows import ROW, Output
from kernels.solve import march
from kernels.solve.outcomes import CONVERGED
from sweep.scene.loading import stages, tolerances
from sweep.scene.plates.scene import build_scene
from tests.support.kernels.pressed_plates import DRIVEN, tube

STEPS = 40


@pytest.fixture(scope="module")
def crushed():
    """Scene, rows and frames of all steps of a glued tube without friction."""
    case = tube(DRIVEN | {"platen": "glued"}, steps=STEPS, friction=0.0)
    of, control = build_scene(case), np.zeros(2, np.int64)
    stage = stages(case, of)[0].stage
    state, rows = of.at_rest(), np.zeros(STEPS, ROW)
    frames = np.zeros((STEPS, of.x_rest.size))
    none = np.zeros((STEPS, 2, 0))
    out = Output(
        rows, np.arange(STEPS), frames, of.bottom, of.top, of.base, of.probes, none,
        of.standing, np.zeros((0, 3)), 0.0,
    )  # fmt: skip
    outcome, written = march.march(
        of.terms, tolerances(case, of, stage), stage, state, out, control
    )
    assert (outcome, written) == (CONVERGED, STEPS)
    return of, rows, frames


def test_the_platen_arrives_and_walls_have_folded(crushed):
    of, rows, frames = crushed
    height = of.x_rest[-1] - of.x_rest[-2]
    assert rows["height"][-1] == pytest.approx(0.6 * height)
    assert rows["bend"].max() > rows["stretch"].min() > 0.0
    assert rows["contact"].max() > 0.0
    assert np.all(np.isfinite(frames))


def test_both_platens_bear_the_same_force(crushed):
    _, rows, _ = crushed
    top, bottom = rows["reaction_top"], rows["reaction_bottom"]
    np.testing.assert_allclose(top, bottom, rtol=0, atol=1e-4 * top.max())


def test_the_book_is_closed(crushed):
    _, rows, _ = crushed
    assert np.abs(rows["residual"]).max() < 1e-6 * rows["work"].max()
    spent = sum(rows[name] for name in ("stretch", "bend", "contact", "friction", "material"))
    spent += rows["integrator"] + rows["residual"]
    given = rows["work"] + rows["injected"]
    np.testing.assert_allclose(given, spent, rtol=0, atol=1e-9 * rows["work"].max())


def test_the_book_enters_what_contact_gains_where_walls_thicken(crushed):
    """Nothing before folds touch, and little after."""
    _, rows, _ = crushed
    gained, touches = np.abs(rows["injected"]), rows["contact"] > 1e-6 * rows["work"]
    assert gained[: np.argmax(touches)].max() < 1e-12 * rows["work"].max()
    assert 1e-5 * rows["work"].max() < gained.max() < 1e-2 * rows["work"].max()


def test_no_walls_cross(crushed):
    of, _, frames = crushed
    touch = of.terms.contact
    for x in frames:
        points = np.ascontiguousarray(x[:-2].reshape(-1, 6)[:, :3])
        unsure = np.empty((1, 2), np.int64)
        assert crossing.count(points, touch.triangles, touch.edges, unsure) == (0, 0)
