"""A small tube pressed along its cell by 40 %: properties of every step of the march."""

import numpy as np
import pytest

from kernels.solve.outcomes import CONVERGED
from sweep.scene.loading import stages
from sweep.scene.plates.scene import build_scene
from tests.support.kernels.pressed_plates import DRIVEN, tube
from tests.support.kernels.solving import go_on
from tests.support.kernels.surfaces import crossings

STEPS = 40


@pytest.fixture(scope="module")
def crushed():
    """Scene, rows and frames of all steps of a glued tube without friction."""
    case = tube(DRIVEN | {"platen": "glued"}, steps=STEPS, friction=0.0)
    of = build_scene(case)
    frames = np.zeros((STEPS, of.x_rest.size))
    outcome, rows = go_on(case, of, of.at_rest(), stages(case, of)[0].stage, frames=frames)
    assert (outcome, len(rows)) == (CONVERGED, STEPS)
    return of, rows, frames


def test_the_platen_arrives_and_walls_have_folded(crushed):
    of, rows, frames = crushed
    height = of.x_rest[-1] - of.x_rest[-2]
    assert rows["height"][-1] == pytest.approx(0.6 * height)
    assert rows["bend"].max() > rows["stretch"].min() > 0.0
    assert rows["contact"].max() > 0.0
    assert np.all(np.isfinite(frames))
    top, bottom = rows["reaction_top"], rows["reaction_bottom"]
    np.testing.assert_allclose(top, bottom, rtol=0, atol=1e-4 * top.max())
    assert {crossings(x, of.terms.contact) for x in frames} == {(0, 0)}


def test_the_book_is_closed(crushed):
    """It enters what contact gains where walls thicken: nothing before folds touch, and little
    after.
    """
    _, rows, _ = crushed
    most = rows["work"].max()
    assert np.abs(rows["residual"]).max() < 1e-6 * most
    spent = sum(rows[name] for name in ("stretch", "bend", "contact", "friction", "material"))
    spent += rows["integrator"] + rows["residual"]
    np.testing.assert_allclose(rows["work"] + rows["injected"], spent, rtol=0, atol=1e-9 * most)
    gained, touches = np.abs(rows["injected"]), rows["contact"] > 1e-6 * rows["work"]
    assert gained[: np.argmax(touches)].max() < 1e-12 * most
    assert 1e-5 * most < gained.max() < 1e-2 * most
