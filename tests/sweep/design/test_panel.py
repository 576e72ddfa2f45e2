"""How many whole specimens a panel has, and its true size."""

import pandas as pd
import pytest

from sweep.design.panel import BEHIND, BESIDE, panel_of

ONE = 12.6e-3, 10e-3  # outer width and depth; side by side, 13 mm each


@pytest.mark.parametrize(("length", "count"), [(25.6, 2), (32.0, 2), (32.2, 3), (6.0, 0), (6.2, 1)])
def test_row_is_the_one_nearest_in_length(length, count):
    """A row of n specimens is n 13 mm - 0.4 mm long."""
    found = panel_of((1e-3 * length, 10e-3), *ONE)
    assert (found.across, found.behind, found.specimens) == (count, 1, count)
    if count:
        off = abs(found.width - 1e-3 * length)
        for other in (count - 1, count + 1):
            assert off <= abs(other * (ONE[0] + BESIDE) - BESIDE - 1e-3 * length)


@pytest.mark.parametrize(
    ("direction", "gap", "depth", "count"),
    [
        *(("in_plane", 0.0, depth, count) for depth, count in ((4.0, 0), (14.0, 1), (25.0, 3))),
        *(("out_of_plane", BESIDE, depth, count) for depth, count in ((4.6, 0), (4.9, 1))),
        *(("out_of_plane", BESIDE, depth, count) for depth, count in ((15.1, 1), (15.3, 2))),
    ],
)
def test_only_what_is_pressed_along_its_cells_has_gaps_behind(direction, gap, depth, count):
    found = panel_of((12.6e-3, 1e-3 * depth), *ONE, BEHIND[direction])
    assert (found.across, found.behind) == (1, count)
    assert found.depth == pytest.approx((ONE[1] + gap) * count - gap)


def test_columns_as_numbers():
    found = panel_of((0.1, 0.05), pd.Series([12.6e-3, 24.6e-3]), 10e-3)
    assert list(found.specimens) == [40, 20]
    assert list(found.width) == pytest.approx([0.1036, 0.0996])
