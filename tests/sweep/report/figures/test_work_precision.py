"""Work-precision diagrams: settings as dots, the best of a method as its line, and the doubt."""

import numpy as np

from sweep.report.figures.case_plots import blank
from sweep.report.figures.work_precision import work_precision
from tests.support.results.made_up_studies import STEPS, all_steps, study


def test_errors_in_percent_are_drawn_over_processor_time_down_to_their_doubt(tmp_path):
    """Two methods in five steps each."""
    (found,) = study(tmp_path, all_steps("backward_euler", "bdf2"))
    figure = blank(9, 3)
    work_precision(figure, {"made up": found})
    (strip,) = figure.subfigs
    assert strip.get_suptitle() == "made up"
    names = [ax.get_title("left") for ax in strip.axes]
    assert names == ["absorbed energy", "peak force", "strain over time"]
    words = [text.get_text() for text in strip.legends[0].get_texts()]
    assert words == ["backward euler", "bdf2", "Pareto front"]
    euler = strip.axes[0].get_lines()[0]
    np.testing.assert_allclose(euler.get_xdata(), [1e-3 / step for step in STEPS])
    errors = [40.0 * 1e3 * step for step in STEPS]
    np.testing.assert_allclose(euler.get_ydata(), errors, rtol=1e-3)
    for ax, reference in zip(strip.axes, found.references.values(), strict=True):
        dots = np.concatenate([points.get_offsets() for points in ax.collections])
        assert dots[:, 1].min() >= 100.0 * reference.doubt * (1.0 - 1e-12)
    (said,) = strip.axes[0].texts
    assert said.get_text() == "uncertainty of the reference: 0.16 %"
