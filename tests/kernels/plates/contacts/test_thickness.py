"""The thickness over which walls touch: of walls that keep their volume."""

import numpy as np
import pytest

from kernels.compile.reference import referred
from kernels.plates.contacts import thickness
from kernels.plates.contacts.contact import MOST_THICKENING
from kernels.plates.element import shell
from kernels.shared.rows import CONTACT, STORED
from kernels.solve import energy_book, workspace
from sweep.scene.plates.scene import build_scene
from tests.support.kernels.pressed_plates import CASES, pinched, whole
from tests.support.kernels.solving import neighbours_of


def fresh(name="glued"):
    """A scene of `CASES` that no other test has changed."""
    return build_scene(CASES[name])


def scaled(of, share):
    """All positions at ``share`` of their place at rest."""
    x = of.x_rest.copy()
    x[:-2].reshape(-1, 6)[:, :3] *= share
    return x


@pytest.mark.parametrize("share", [1.0, 0.9, 1.2])
def test_walls_keep_their_volume(share):
    of = fresh()
    x, touch = scaled(of, share), of.terms.contact
    problem = whole(of, x).problem
    assert thickness.renew(problem, x)
    expected = touch.rest_thickness / share**2
    np.testing.assert_allclose(touch.thickness, expected, rtol=2e-3)  # walls are bowed a little
    listed = referred(problem.neighbours).pairs
    np.testing.assert_array_equal(
        listed.d_contact, neighbours_of(x, of.terms).pairs.d_contact[: listed.d_contact.size]
    )


def test_contact_covers_a_thickness_up_to_a_limit():
    of = fresh()
    x, touch = scaled(of, 0.7), of.terms.contact
    thickness.renew(whole(of, x).problem, x)
    np.testing.assert_array_equal(touch.thickness, MOST_THICKENING * touch.rest_thickness)
    assert touch.reach == touch.thickness.max()


def test_a_march_recalls_the_thickness_of_its_state():
    of = fresh()
    state, touch = of.at_rest(), of.terms.contact
    x = scaled(of, 0.9)
    scratch, weight = shell.make_scratch(), np.zeros(len(of.mesh.rest))
    thickness.measure(x, state.memory, of.terms.shell, touch.original, scratch, weight)
    of.terms.make_buffers(state.memory)
    np.testing.assert_allclose(touch.thickness, touch.rest_thickness / 0.81, rtol=2e-3)
    of.terms.make_buffers(of.at_rest().memory)
    np.testing.assert_array_equal(touch.thickness, touch.rest_thickness)


def test_the_book_enters_what_contact_gains():
    of = fresh()
    x = pinched(of)
    of_step = whole(of, x)
    state, found = of.at_rest(), workspace.make_workspace(x.size, STORED).evaluation
    state.x[:] = x
    of_step.problem.evaluate(x, of_step.step, found)
    state.stored[:], before = found.stored, found.stored.copy()
    assert before[CONTACT] > 0.0
    assert energy_book.project(of_step.problem, of_step.step, state, found, np.zeros(x.size))
    _, after = of_step.found(x)
    assert after.stored[CONTACT] != pytest.approx(before[CONTACT], rel=1e-6)
    assert state.book[0].injected == pytest.approx(after.stored.sum() - before.sum(), rel=1e-9)
    np.testing.assert_array_equal(state.stored, after.stored)
    np.testing.assert_array_equal(state.x, x)


def test_nothing_is_renewed_where_nothing_touches():
    case = CASES["glued"]
    contact = case.contact.model_copy(update={"model": "none"})
    of = build_scene(case.model_copy(update={"contact": contact}))
    assert not thickness.renew(whole(of, of.x_rest).problem, of.x_rest)
