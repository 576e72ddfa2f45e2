"""Richardson's extrapolation: exact for powers, silent where there are none."""

import numpy as np
import pytest

from sweep.ranking.richardson import limit

HALVED = [1.0, 0.5, 0.25, 0.125]
UNEVEN = [1 / 2, 1 / 3, 1 / 6, 1 / 12]


def powers(sizes, order, along=(3.0,)):
    """Values 7 + along x size^order."""
    return [7.0 + np.array(along) * size**order for size in sizes]


@pytest.mark.parametrize("sizes", [HALVED, UNEVEN, HALVED[1:]])
@pytest.mark.parametrize("order", [0.7, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("along", [(3.0,), (-1.0, 2.0, 0.5)])
def test_powers_are_taken_to_their_limit(sizes, order, along):
    values = powers(sizes, order, along)
    found = limit(sizes, values)
    assert found.order == pytest.approx(order, abs=1e-5)
    np.testing.assert_allclose(values[-1] + found.correction, 7.0, rtol=1e-5)
    assert found.doubt == pytest.approx(np.sqrt(np.mean((values[-1] - 7.0) ** 2)), rel=1e-3)


@pytest.mark.parametrize(
    "values",
    [
        [1.0, 2.0, 1.5, 1.75],  # to and fro
        [1.0, 2.0, 3.0, 4.0],  # away
        [1.0, 3.0, 2.0, 1.5],  # falls into line only at the end
        [1.0, 1.5],  # too few
    ],
)
def test_no_order_and_no_correction_without_a_power(values):
    found = limit(HALVED[: len(values)], [np.array([value]) for value in values])
    assert np.isnan(found.order)
    assert found.correction == 0.0
    assert found.doubt == max(abs(np.diff(values))[-2:])


def test_curves_that_change_shape_have_no_order():
    values = [np.array([0.0, 0.0]), np.array([1.0, 0.0]), np.array([1.0, 0.5])]
    assert np.isnan(limit(HALVED[:3], values).order)
