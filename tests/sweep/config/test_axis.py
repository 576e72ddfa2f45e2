"""The values of the axes of a search."""

from collections import Counter

import numpy as np
import pytest

from sweep.config.axis import Choice, Interval, Written, rounded_down

SHARES = np.linspace(0.0, 1.0, 1201)


def test_every_whole_number_has_an_equal_part():
    cells = Interval("lattice.cells_x", 2, 5)
    found = Counter(cells.at(share).value for share in SHARES)
    assert list(found) == [2, 3, 4, 5]
    assert all(type(value) is int for value in found)
    assert [count / len(SHARES) for count in found.values()] == pytest.approx([0.25] * 4, abs=2e-3)


def test_every_choice_has_an_equal_part():
    kinds = Choice(tuple(Written(kind, kind) for kind in ("a", "b", "c")))
    found = Counter(kinds.at(share).value for share in SHARES)
    assert [count / len(SHARES) for count in found.values()] == pytest.approx([1 / 3] * 3, abs=2e-3)
    assert [written.value for written in kinds.probes] == ["b", "c", "a"]


def test_numbers_of_an_interval_have_four_digits_and_stay_inside():
    walls = Interval("lattice.wall_thickness", 0.41234567e-3, 1.2e-3, "m")
    found = [walls.at(share).value for share in SHARES]
    assert (found[0], found[-1]) == (0.41234567e-3, 1.2e-3)
    assert np.all(np.diff(found) >= 0.0)
    assert all(value == float(f"{value:.4g}") for value in found[1:])
    assert walls.at(0.5) == Written(0.8062e-3, "0.0008062 m", "lattice.wall_thickness")


@pytest.mark.parametrize(
    ("value", "down"), [(0.12345, 0.1234), (0.12346, 0.1234), (2.0, 2.0), (1.00001e-3, 1e-3)]
)
def test_rounding_down_never_rounds_up(value, down):
    assert rounded_down(value) == pytest.approx(down, rel=1e-12)
    assert rounded_down(value) <= value
