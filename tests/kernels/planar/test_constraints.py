"""Constraints of lattices: periodic images, and the pull of a prescribed move.

All coordinates of a period are a matrix F (n, k) times those that it leads and does not lead.
"""

import numpy as np
import pytest

from sweep.scene.periodic import build_periodic
from tests.support.designs.periods import follow, lattice_of, pressed
from tests.support.kernels.solving import reduction, whole
from tests.support.kernels.states import bent, driven

PLATENS = ["glued", "sliding", "contact"]
MOVE = -1e-4  # m


def random(of, seed):
    return np.random.default_rng(seed).uniform(-1, 1, of.x_rest.size)


def own(of):
    layout = of.terms.layout
    free = np.setdiff1d(layout.leader[layout.leader >= 0], [*layout.images[:, 0], layout.driven])
    return [*free, layout.driven]


@pytest.fixture(scope="module")
def endless():
    """One period of a honeycomb, whose height is prescribed."""
    of = build_periodic(pressed(lattice_of("hex", (2, 2), 0.08)))
    assert len(of.terms.layout.images) > 0
    return of


def test_forces_on_images_act_on_what_they_follow(endless):
    g, residual, expected = random(endless, 0), random(endless, 1), np.zeros(endless.x_rest.size)
    expected[own(endless)] = follow(endless).T @ g
    whole(endless, endless.x_rest).problem.reduce(g, residual)
    np.testing.assert_allclose(residual, expected, rtol=0, atol=1e-13)


def test_a_prescribed_height_moves_the_images(endless):
    move = np.zeros(endless.x_rest.size)
    whole(endless, endless.x_rest).problem.lead(MOVE, move)
    np.testing.assert_allclose(move, MOVE * follow(endless)[:, -1], rtol=1e-15)
    images = endless.terms.layout.images[:, 0]
    assert np.count_nonzero(move[images]) > 0


@pytest.mark.parametrize("platen", PLATENS)
def test_a_prescribed_move_pulls_with_its_column_of_the_hessian(platen):
    scene = driven(platen)
    x = bent(scene)
    args, change, lead = whole(scene, x), np.zeros(x.size), np.zeros(x.size)
    args.factor(x)
    args.problem.pull(MOVE, change)
    args.problem.lead(MOVE, lead)
    others = reduction(scene)
    expected = others.T @ args.hessian(x) @ lead
    scale = abs(expected).max()
    assert scale > 0.0
    np.testing.assert_allclose(others.T @ change, expected, rtol=1e-9, atol=1e-9 * scale)
