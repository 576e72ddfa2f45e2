"""Sizes that a machine writes above its table."""

import numpy as np
import pytest

from sweep.coupon.specimen import stated_size
from sweep.coupon.table import Table


def table(*rows, decimal="."):
    return Table(("a",), ("",), np.zeros((1, 1)), [list(row) for row in rows], decimal, ())


@pytest.mark.parametrize(
    ("row", "name", "size"),
    [
        (("Cross-section", "7.335", "mm²"), "area", 7.335e-6),
        (("Section", "5.96", "(mm^2)"), "area", 5.96e-6),
        (("Gage length, standard travel", "30", "mm"), "gauge", 0.03),
        (("L0 - course standard", "25", "mm"), "gauge", 0.025),
        (("Specimen properties : Anvil height", "3.11", "mm"), "gauge", 3.11e-3),
        (("Final area", "7.3", "mm2"), "area", None),
        (("Area", "7.3", "mm"), "area", None),
        (("Area", "-7.3", "mm2"), "area", None),
        (("Area", "", "mm2"), "area", None),
        (("Gauge",), "gauge", None),
    ],
)
def test_a_size_is_read_by_its_label_and_unit(row, name, size):
    found = stated_size(table(row), name)
    assert found == (size and (pytest.approx(size), row[0]))


def test_decimal_commas_and_several_sizes():
    assert stated_size(table(("Area", "7,5", "mm2"), decimal=","), "area") == (7.5e-6, "Area")
    two = table(("Area", "7", "mm2"), ("Section", "8", "mm2"))
    assert stated_size(two, "area") is None
