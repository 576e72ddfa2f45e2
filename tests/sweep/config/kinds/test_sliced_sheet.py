"""The gyroid of slicers: period and line by their formulas, the nearest share that fits."""

from math import pi

import pytest

from sweep.config.case import Case
from sweep.config.kinds.sliced_sheet import period_of
from sweep.config.kinds.table import RefusedError
from sweep.design.slicer.patterns import ROUNDED

MM = 1e-3
LINE = 0.45 * MM - 0.2 * MM * ROUNDED


def gyroid(**lattice):
    values = {"slicer": "prusa", "pattern": "gyroid", "infill": 0.15, "height": 25 * MM}
    return Case.of(lattice=values | lattice, loading={"mode": "displacement"}).lattice


def test_the_period_is_that_of_the_slicer():
    assert period_of("prusa", 0.15, LINE) == pytest.approx(2 * pi / 2.44 * LINE / 0.15)
    assert period_of("orca", 0.15, LINE) == period_of("prusa", 0.15, LINE)
    assert period_of("cura", 0.2, 0.4 * MM) == pytest.approx(2.41 * 0.4 * MM / 0.2)


def test_the_share_is_the_nearest_that_fits():
    made = gyroid()
    assert made.infill == pytest.approx(0.15, rel=0.06)
    assert made.period == pytest.approx(period_of("prusa", made.infill, LINE), rel=1e-12)
    again = gyroid(infill=made.infill)
    assert again.infill == pytest.approx(made.infill, rel=1e-12)


def test_what_is_extruded_is_nearly_the_share_of_the_box():
    """2.44 is a number of the slicer's makers: lines fill 0.955 of the share."""
    made = gyroid(infill=0.2)
    filled = made.extruded / (made.width * made.height * made.depth)
    assert filled == pytest.approx(0.955 * made.infill, rel=2e-3)


def test_several_lines_make_a_thicker_wall_at_the_same_share():
    one, two = gyroid(slicer="orca"), gyroid(slicer="orca", fill_multiline=2)
    assert two.wall_thickness == pytest.approx(2 * one.wall_thickness)
    assert two.period == pytest.approx(2 * one.period, rel=0.15)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"infill": 0.01}, "at least 2 %"),
        ({"infill": None}, 'a share such as "15 %"'),
        ({"fill_multiline": 2}, 'more with lattice.slicer "orca"'),
        ({"layer_height": 0.6 * MM}, "at most the line width"),
        ({"infill": 0.6}, "below a fifth of the period"),
    ],
)
def test_what_a_slicer_does_not_print_is_refused(values, words):
    with pytest.raises(RefusedError) as refused:
        gyroid(**values)
    assert words in str(refused.value)
