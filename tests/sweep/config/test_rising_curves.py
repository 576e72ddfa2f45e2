"""Curves of a material that relaxes: their stress must rise with strain, to their ends."""

import pytest

from sweep.config.case import Material
from sweep.config.material_file import available, locate, not_rising, read_record
from sweep.scene.material import stress_law
from tests.support.records import HEADER

LEVEL = "0.01,1e5\n0.05,2e5\n0.1,10e5\n0.2,10.1e5\n"


def test_a_curve_that_ends_level_does_not_relax(own_record):
    """Its record rises, but the last tangent of its law, with which it goes on, is flat."""
    path = own_record(HEADER + LEVEL)
    law = stress_law(Material(name=str(path)))
    _, c1, c2, c3 = law.coefficients[-1]
    width = law.knots[-1] - law.knots[-2]
    modulus = law.coefficients[0, 1]
    assert c1 + 2.0 * c2 * width + 3.0 * c3 * width**2 == pytest.approx(0.0, abs=1e-9 * modulus)
    with pytest.raises(ValueError, match=r"does not rise beyond a strain of 0\.2"):
        Material(name=str(path), loss=0.3)


@pytest.mark.parametrize("name", available())
def test_shipped_curves_rise(name):
    record = read_record(locate(name))
    assert not_rising(record.strain, record.stress) is None
    assert Material(name=name, loss=0.3).reference_time == record.reference_time == 1.0


@pytest.mark.parametrize(
    ("strain", "stress", "at"),
    [
        ((-0.5, -0.2, 0.1, 0.2), (-2.0, -2.0, 1.0, 2.0), -0.5),
        ((-0.5, -0.2, 0.1, 0.2), (-2.0, -1.0, 1.0, 1.0), 0.1),
        ((-0.5, -0.4, -0.2, 0.1, 0.2), (-10.1, -10.0, -1.0, 1.0, 2.0), -0.5),
        ((0.002, 0.02, 0.1), (-0.1, 1.0, 5.0), None),
    ],
)
def test_where_a_curve_does_not_rise(strain, stress, at):
    """Its toe does not count, which is replaced by a straight line."""
    assert not_rising(strain, stress) == at
