"""How many specimens a panel has."""

import pandas as pd
import pytest

from sweep.design.panel import specimens


@pytest.mark.parametrize(("area", "count"), [(5.0e-4, 4.0), (5.3e-4, 4.0), (5.7e-4, 5.0)])
def test_whole_number_nearest_to_the_area(area, count):
    assert specimens(area, 0.012, 0.01) == count
    assert list(specimens(area, pd.Series([0.012, 0.024]), 0.01)) == [count, round(count / 2)]
