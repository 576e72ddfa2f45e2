"""The factor of a step: of all its terms, with room for near pairs; with a shift."""

import numpy as np
import pytest

from tests.support.kernels.solving import neighbours_of, reduction, whole
from tests.support.kernels.states import (
    DT,
    SCENES,
    SIZE,
    STATES,
    loaded,
    step_to,
)


@pytest.mark.parametrize(("dt", "shift"), [(DT, 0.0), (np.inf, 0.0), (np.inf, 30.0)])
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", SCENES)
def test_the_factor_is_that_of_the_sum_of_all_terms(name, state, shift, dt):
    """All free coordinates have room. Tied ones move together, held ones do not move.

    If a pivot is negative, the direction returned with it has that curvature.
    """
    scene = SCENES[name]()
    x = STATES[state](scene)
    args, R = step_to(scene, x, 0, dt), reduction(scene)
    negative, pivot, missing = args.factor(x, shift)
    assert not missing
    weights = shift * np.diag(scene.terms.coordinates.scale**2)
    full = R.T @ (args.hessian(x) + weights) @ R
    size = np.abs(full).max()
    definite = np.linalg.eigvalsh(full)[0] > -1e-12 * size
    assert definite == (not negative)
    if not negative:
        b = full @ np.random.default_rng(3).uniform(-1, 1, len(full))  # that is borne
        y = args.solve(np.linalg.lstsq(R.T, b)[0])
        short = np.linalg.lstsq(R, y)[0]
        np.testing.assert_allclose(R @ short, y, rtol=0, atol=1e-12 * np.abs(y).max())
        np.testing.assert_allclose(full @ short, b, rtol=0, atol=1e-9 * np.abs(b).max())
    else:
        d = args.escape()
        short = np.linalg.lstsq(R, d)[0]
        np.testing.assert_allclose(R @ short, d, rtol=0, atol=1e-12 * np.abs(d).max())
        assert short @ full @ short == pytest.approx(pivot, rel=1e-6)


@pytest.mark.parametrize("state", ["pinched", "leaning"])
def test_what_has_come_near_needs_room_and_gets_it(state):
    """A system found at rest has none for contacts that came later; one found there has."""
    scene = loaded(contact=dict(friction=0.0))
    x = STATES[state](scene)
    args = whole(scene, x)
    at_rest = neighbours_of(scene.x_rest, scene.terms, SIZE)
    assert args.beside(at_rest).energy(x) == pytest.approx(args.energy(x), rel=1e-12)
    assert args.beside(at_rest).factor(x)[2]
    assert not args.factor(x)[2]
    assert np.any(args.neighbours.system.kind != at_rest.system.kind)
