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
def test_both_sides_of_the_sheet_are_alike(name):
    """A shift by half a period, or an inversion, turns the function round."""
    of = LEVEL_SETS[name]
    turned = {
        "gyroid": -PHASES,
        "schwarz_p": PHASES + np.pi,
        "schwarz_d": PHASES + np.array([np.pi, np.pi, np.pi]),
    }[name]
    np.testing.assert_allclose(of.value(turned), -of.value(PHASES), atol=1e-14)
