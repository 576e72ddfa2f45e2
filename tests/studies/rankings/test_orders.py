"""Orders of designs: the compared values, and the comparison."""

import numpy as np
import pandas as pd
import pytest

from tests.studies.rankings import orders


def test_orders_are_compared_where_both_are_known():
    one, two = pd.Series([1.0, 2.0, 3.0, np.nan]), pd.Series([1.0, 3.0, 2.0, 9.0])
    assert orders.compared(one, one) == (pytest.approx(1.0), True)
    assert orders.compared(one, two) == (pytest.approx(0.5), False)


def test_what_failed_has_no_merit_and_less_strain_is_better():
    rows = pd.DataFrame(
        {
            "loading_mode": "force",
            "peak_strain": [0.2, 0.1, 0.3],
            "absorbed_energy_until_packed_J": 1.0,
            "mass_g": 2.0,
            "status": ["converged", "converged", "stopped"],
        }
    )
    np.testing.assert_array_equal(orders.merits(rows), [-0.2, -0.1, np.nan])
    crushed = rows.assign(loading_mode="displacement")
    np.testing.assert_array_equal(orders.merits(crushed), [0.5, 0.5, np.nan])
