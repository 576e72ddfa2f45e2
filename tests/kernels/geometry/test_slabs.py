"""Area of convex polygons by slabs: the heights that cut it, and the union.

More in tests/sweep/design/test_area.py, through the function that the program calls.
"""

import numpy as np
import pytest

from kernels.geometry import slabs


def closed(*corners):
    return np.array([*corners, corners[0]], float)


def boxes(loops):
    """Loops in the order that `heights` asks for, and their boxes."""
    loops = np.array(loops)
    loops = loops[np.argsort(loops.min(axis=1)[:, 1], kind="stable")]
    return loops, loops.min(axis=1), loops.max(axis=1)


def cut(loops, room=64):
    """All heights, ascending."""
    found = np.full(room, np.nan)
    count = slabs.heights(*boxes(loops), found)
    assert count <= room
    return np.sort(found[:count])


TRIANGLE = closed((0, 0), (4, 0), (0, 4))
TURNED = closed((4, 2), (2, 6), (0, 2))  # the sides cross at (2, 2) and (2/3, 10/3)


def test_heights_are_those_of_corners_and_of_crossings():
    assert np.unique(cut([TRIANGLE]).round(12)).tolist() == [0.0, 4.0]
    both = np.unique(cut([TRIANGLE, TURNED]).round(12))
    np.testing.assert_allclose(both, [0.0, 2.0, 10 / 3, 4.0, 6.0])


def test_sides_that_are_parallel_or_end_before_do_not_cross():
    beside = TRIANGLE + np.array([5.0, 0.0])
    along = TRIANGLE + np.array([1.0, -1.0])
    assert np.unique(cut([TRIANGLE, beside])).tolist() == [0.0, 4.0]
    assert set(np.unique(cut([TRIANGLE, along]))) == {-1.0, 0.0, 3.0, 4.0}


def test_heights_that_do_not_fit_are_counted_all_the_same():
    found = np.zeros(3)
    of = boxes([TRIANGLE, TURNED])
    assert slabs.heights(*of, found) == len(cut([TRIANGLE, TURNED])) > 3


@pytest.mark.parametrize(
    ("loops", "area"),
    [
        ([TRIANGLE], 8.0),
        ([TRIANGLE, TRIANGLE], 8.0),
        ([TRIANGLE, TURNED], 8.0 + 8.0 - 4 / 3),
        ([TRIANGLE, closed((1, 1), (1.5, 1), (1, 1.5))], 8.0),
        ([TRIANGLE, closed((0, -3), (2, -3), (1, -2))], 9.0),
        ([closed((0, 0), (1, 0), (2, 0)), TRIANGLE], 8.0),
    ],
)
def test_areas_by_hand(loops, area):
    levels = cut(loops)
    assert slabs.area(*boxes(loops), levels) == pytest.approx(area, rel=1e-13)
    more = np.sort(np.append(levels, np.linspace(levels[0], levels[-1], 50)))
    assert slabs.area(*boxes(loops), more) == pytest.approx(area, rel=1e-13)
