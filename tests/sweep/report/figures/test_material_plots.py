"""Pictures of materials: their curves, in MPa."""

import numpy as np
import pytest

from sweep.report.figures.case_plots import blank
from sweep.report.figures.material_plots import COLORS, coupon_fit, material_curves

STRAIN = np.linspace(-0.5, 1.0, 31)


def test_curves_are_drawn_whole_and_near_the_origin():
    figure, names = blank(6.0, 3.0), [f"material {k}" for k in range(len(COLORS) + 1)]
    material_curves(
        figure, {name: (STRAIN, (1.0 + k) * 1e6 * STRAIN) for k, name in enumerate(names)}
    )
    whole, near = figure.axes
    lines = whole.get_lines()[: len(names)]
    assert [line.get_label() for line in lines] == names
    assert lines[1].get_ydata() == pytest.approx(2.0 * STRAIN)
    looks = {(line.get_color(), line.get_linestyle()) for line in lines}
    assert len(looks) == len(names)
    assert near.get_xlim() == (-0.1, 0.1)
    assert near.get_ylim() == pytest.approx((-0.84, 0.84), abs=0.01)


def test_fit_is_drawn_over_its_record_with_the_difference():
    figure = blank(6.0, 5.0)
    coupon_fit(figure, (STRAIN, 1e6 * STRAIN), (STRAIN, 1.1e6 * STRAIN), "a fit")
    above, below = figure.axes
    record, law = above.get_lines()[:2]
    assert (record.get_label(), law.get_label()) == ("record", "law")
    assert law.get_ydata() == pytest.approx(1.1 * STRAIN)
    assert below.get_lines()[0].get_ydata() == pytest.approx(10.0 * STRAIN)
    assert above.get_title(loc="left") == "a fit"
