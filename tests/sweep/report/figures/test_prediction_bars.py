"""Predicted ranges as bars over the measured value."""

import pytest

from sweep.ranking.comparison import Comparison, Range
from sweep.report.figures.case_plots import BLUE, VERMILION, blank
from sweep.report.figures.prediction_bars import prediction_bars, size


def test_bars_are_ranges_over_the_middle_of_the_measured_value():
    rows = [
        Comparison("a", "x", "", Range(1.0, 3.0), Range(1.8, 2.2)),
        Comparison("b", "y", "", Range(6.0, 8.0), Range(4.0, 4.0)),
        Comparison("c", "z", "", Range(6.0, 8.0), None),
    ]
    figure = blank(*size(rows))
    ax = figure.subplots()
    prediction_bars(ax, rows)
    bars = [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in ax.patches]
    assert bars == [pytest.approx((0.5, 1.5)), pytest.approx((1.5, 2.0))]
    handles, labels = ax.get_legend_handles_labels()
    colors = dict(zip(labels, handles, strict=True))
    assert colors["predicted range, inside"].get_color() == BLUE
    assert colors["outside"].get_color() == VERMILION
    assert [label.get_text() for label in ax.get_yticklabels()] == ["a: x", "b: y"]
