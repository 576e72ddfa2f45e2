"""Work-precision diagrams: settings as dots, the best of a method as its line, and the doubt."""

import numpy as np
import pytest

from sweep.report.figures.case_plots import blank
from sweep.report.figures.work_precision import work_precision
from tests.support.results.made_up_studies import STEPS, all_steps, study


@pytest.fixture
def drawn(tmp_path):
    """Two methods in five steps each: the study, and its panels."""
    (found,) = study(tmp_path, all_steps("backward_euler", "bdf2"))
    figure = blank(9, 3)
    work_precision(figure, {"made up": found})
    return found, figure


def test_every_measure_has_a_panel_below_the_title_of_the_scene(drawn):
    _, figure = drawn
    (strip,) = figure.subfigs
    assert strip.get_suptitle() == "made up"
    names = [ax.get_title("left") for ax in strip.axes]
    assert names == ["absorbed energy", "peak force", "strain over time"]
    (legend,) = strip.legends
    words = [text.get_text() for text in legend.get_texts()]
    assert words == ["backward euler", "bdf2", "Pareto front"]


def test_lines_are_errors_in_percent_over_processor_time(drawn):
    found, figure = drawn
    euler = figure.subfigs[0].axes[0].get_lines()[0]
    np.testing.assert_allclose(euler.get_xdata(), [1e-3 / step for step in STEPS])
    errors = [40.0 * 1e3 * step for step in STEPS]
    np.testing.assert_allclose(euler.get_ydata(), errors, rtol=1e-3)
    assert found.settings["energy"].max() == pytest.approx(0.4, rel=1e-3)


def test_no_error_is_drawn_below_what_the_reference_is_sure_of(drawn):
    found, figure = drawn
    for ax, reference in zip(figure.subfigs[0].axes, found.references.values(), strict=True):
        dots = np.concatenate([points.get_offsets() for points in ax.collections])
        assert dots[:, 1].min() >= 100.0 * reference.doubt * (1.0 - 1e-12)
    (said,) = figure.subfigs[0].axes[0].texts
    assert said.get_text() == "uncertainty of the reference: 0.16 %"
