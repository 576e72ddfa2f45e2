"""The potential of a step of plates: the sum of all its terms, and its derivatives."""

import numpy as np
import pytest

from kernels.plates.contacts import contact, mirror
from kernels.plates.element import shell
from kernels.shared.rows import BEND, CONTACT, STRETCH
from tests.support.kernels.pressed_plates import (
    CASES,
    STATES,
    hessian_error,
    pinched,
    scene,
    shaken,
    slope,
    unit,
    whole,
)

STEP = 1e-5  # of differences, in units of the coordinates


def direction(of, seed):
    return unit(of) * np.random.default_rng(seed).uniform(-1, 1, of.x_rest.size)


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", CASES)
def test_the_gradient_is_that_of_the_energy(name, state):
    """Along random moves of all coordinates, held ones and platens too."""
    of = scene(name)
    x = STATES[state](of)
    args = whole(of, x)
    g = args.gradient(x)
    for seed in range(3):
        move = direction(of, seed)
        assert slope(args.energy, x, move, STEP) == pytest.approx(
            g @ move, abs=1e-8 * np.linalg.norm(g * unit(of))
        )


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", CASES)
def test_the_matrix_is_the_hessian(name, state):
    """Along random moves of the unknowns and their followers."""
    of = scene(name)
    for seed in range(3):
        assert hessian_error(of, STATES[state](of), seed, STEP) < 1e-7


@pytest.mark.parametrize("name", CASES)
def test_the_sum_has_all_terms_and_each_of_them_counts(name):
    of = scene(name)
    x, terms = pinched(of), of.terms
    args = whole(of, x)
    energy, at = args.found(x)
    pairs, touching = args.neighbours.pairs, args.neighbours.touching
    none = np.zeros_like(x)
    parts = np.zeros(3)
    walls = shell.evaluate(
        x, of.mesh.frames, terms.shell, terms.law, args.problem.buffers.memory,
        shell.make_scratch(), none, parts,
    )  # fmt: skip
    stored = contact.evaluate(x, terms.contact, pairs, 0.0, touching, none)
    imaged = mirror.evaluate(x, terms.contact, terms.mirror, none)
    assert (imaged > 0.0) == (name == "loose quarter")
    assert at.stored[STRETCH] == pytest.approx(parts[0], rel=1e-12)
    assert at.stored[STRETCH] + at.stored[BEND] == pytest.approx(walls, rel=1e-12)
    assert at.stored[CONTACT] == pytest.approx(stored + imaged, rel=1e-12)
    moved = x - args.step.x_pred
    inertia = 0.5 * terms.coordinates.mass @ moved**2 / args.step.h**2 * args.step.dynamic
    assert (inertia > 0.0) == (name == "struck")
    rubbed = at.sums[0]["friction"]
    assert rubbed > 0.0
    assert min(at.stored) > 0.0
    assert energy == pytest.approx(walls + stored + imaged + inertia + rubbed, rel=1e-12)
    np.testing.assert_allclose(at.u, x - args.step.x0, rtol=0, atol=0)


@pytest.mark.parametrize("name", CASES)
def test_at_rest_there_is_nothing(name):
    of = scene(name)
    args = whole(of, of.x_rest, past=False)
    _, at = args.found(of.x_rest)
    assert max(at.stored) < 1e-18
    assert np.abs(at.elastic / of.terms.coordinates.lever).max() < 1e-9


@pytest.mark.parametrize("name", CASES)
def test_a_commit_changes_coordinates_but_no_energy(name):
    """Rotations begin again at zero; forces on them belong to the new coordinates."""
    of = scene(name)
    x = pinched(of)
    args = whole(of, x)
    _, before = args.found(x)
    moved, at = x.copy(), before.stored.copy()
    args.problem.commit(moved, args.step, before)
    points = slice(0, x.size - 2)
    assert not moved[points].reshape(-1, 6)[:, 3:].any()
    assert np.abs(x - moved).max() > 1e-3
    np.testing.assert_array_equal(
        moved[points].reshape(-1, 6)[:, :3], x[points].reshape(-1, 6)[:, :3]
    )
    _, after = args.found(moved)
    np.testing.assert_allclose(after.stored, at, rtol=1e-12)
    forces = [found.elastic[points].reshape(-1, 6)[:, :3] for found in (before, after)]
    np.testing.assert_allclose(*forces, rtol=0, atol=1e-10 * np.abs(forces[0]).max())
    move = direction(of, 5)
    expected = args.gradient(moved) @ move
    assert slope(args.energy, moved, move, STEP) == pytest.approx(
        expected, abs=1e-8 * np.linalg.norm(args.gradient(moved) * unit(of))
    )


def test_lagged_forces_are_exchanged_for_those_of_another_place():
    of = scene("glued")
    x = pinched(of)
    args = whole(of, x)
    energy, at = args.found(x)
    assert args.problem.lag(shaken(of, x, 7, 0.01))
    exchanged = args.problem.exchange(args.step, at)
    expected, fresh = args.found(x)
    assert exchanged != pytest.approx(energy, rel=1e-9)
    assert exchanged == pytest.approx(expected, rel=1e-12)
    np.testing.assert_allclose(at.g, fresh.g, rtol=0, atol=1e-12 * np.abs(fresh.g).max())
