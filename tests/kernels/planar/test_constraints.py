"""The pull of a prescribed move; other constraints: `tests/kernels/shared/test_followers.py`."""

import numpy as np
import pytest

from tests.support.kernels.solving import reduction, whole
from tests.support.kernels.states import bent, driven

PLATENS = ["glued", "sliding", "contact"]
MOVE = -1e-4  # m


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
