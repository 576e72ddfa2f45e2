"""Functions of periodic surfaces: their gradients and symmetries."""

import numpy as np
import pytest

from sweep.design.surfaces.level_set import LEVEL_SETS

PHASES = np.random.default_rng(1).uniform(0, 2 * np.pi, (50, 3))
STEP = 1e-5


@pytest.mark.parametrize("name", LEVEL_SETS)
def test_gradients_are_differences(name):
    of = LEVEL_SETS[name]
    found = of.gradient(PHASES)
    for k, way in enumerate(STEP * np.eye(3)):
        slope = (of.value(PHASES + way) - of.value(PHASES - way)) / (2 * STEP)
        np.testing.assert_allclose(found[:, k], slope, atol=1e-9)


@pytest.mark.parametrize("name", LEVEL_SETS)
def test_both_sides_of_the_sheet_and_all_axes_are_alike(name):
    """A shift by half a period, or an inversion, turns the function round."""
    value = LEVEL_SETS[name].value
    turned = -PHASES if name == "gyroid" else PHASES + np.pi
    np.testing.assert_allclose(value(turned), -value(PHASES), atol=1e-14)
    np.testing.assert_allclose(value(PHASES[:, [1, 2, 0]]), value(PHASES), atol=1e-14)
