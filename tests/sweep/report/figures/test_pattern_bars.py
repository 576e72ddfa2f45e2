"""Bars of designs of several patterns."""

from dataclasses import replace

import numpy as np
import pytest

from sweep.ranking.rank import ranked
from sweep.report.figures.case_plots import blank
from sweep.report.figures.pattern_bars import panel_size, pattern_bars
from tests.support.results.specimens import designs, summary


def legend_of(figure):
    """The words of the legends of a figure."""
    return [text.get_text() for key in figure.legends for text in key.get_texts()]


def test_several_patterns_are_drawn_side_by_side():
    table = summary(*designs([1.0, 1.0], [0.2, 0.1])).assign(lattice_kind=["hex", "square"])
    ranking = ranked(table.assign(**{"lattice.orientation": ["flat", ""]}), top=None)
    figure = blank(6, 3)
    pattern_bars(figure, ranking)
    (ax,) = figure.axes
    labels = [label.get_text() for label in ax.get_yticklabels()]
    assert labels == ["square", "hex, orientation flat"]
    assert [bar.get_width() for bar in ax.patches] == [0.1, 0.2]
    assert ax.get_xlabel() == "energy absorbed\nuntil densification, J/g"


@pytest.mark.parametrize(("budgets_g", "grey"), [((), 0), ((1.0,), 1), ((1.0, 2.0), 0)])
def test_bars_above_all_budgets_are_grey(budgets_g, grey):
    ranking = ranked(summary(*designs([1.0, 2.0], [0.1, 0.4])), top=None)
    figure = blank(6, 3)
    pattern_bars(figure, replace(ranking, budgets_g=budgets_g))
    (ax,) = figure.axes
    first, second = (bar.get_facecolor() for bar in ax.patches)
    assert (first != second) == bool(grey)
    assert legend_of(figure) == ["above all budgets"] * grey


@pytest.mark.parametrize("aspect", [1.0, 2.5, 8.0])
def test_a_drawing_stands_beside_each_bar(aspect):
    rows = designs([1.0, 1.0], [0.2, 0.1])
    ranking = ranked(summary(*rows), top=None)
    square = {
        "position_m": np.array([[[0.0, 0.0], [aspect, 0.0], [aspect, 1.0]]]) * 1e-2,
        "edges": np.array([[0, 1], [1, 2]]),
        "edge_thickness_m": np.full(2, 1e-3),
    }
    figure = blank(*panel_size(ranking.table, drawn=True))
    pattern_bars(figure, ranking, dict.fromkeys(ranking.table["case_id"], square))
    figure.canvas.draw()
    (ax,) = figure.axes
    assert len(ax.child_axes) == 2
    for place, drawing in enumerate(ax.child_axes):
        assert len(drawing.patches) == 1
        drawing.apply_aspect(drawing.get_axes_locator()(drawing, None))
        bar, box = (patch.get_window_extent() for patch in (ax.patches[place], *drawing.patches))
        assert box.width == pytest.approx(aspect * box.height, rel=0.03 * aspect)
        assert box.x1 < bar.x0
        assert bar.y0 < 0.5 * (box.y0 + box.y1) < bar.y1


def test_what_is_not_to_be_trusted_is_open_and_every_scene_has_a_panel():
    rows = designs([1.0, 1.0], [0.2, 0.1]) + designs([1.0], [0.3], platen="contact")
    rows[1] |= {"contact_model": "none", "max_crossings": 2}
    ranking = ranked(summary(*rows), top=None)
    figure = blank(*panel_size(ranking.table))
    pattern_bars(figure, ranking)
    assert [[bar.get_fill() for bar in ax.patches] for ax in figure.axes] == [[False, True], [True]]
    scenes = [ax.get_title("left") for ax in figure.axes]
    assert scenes == [f"crushed to 50 %, {platen} platens" for platen in ("glued", "contact")]


def test_bars_of_coarse_steps_are_marked():
    rows = designs([1.0, 1.0], [0.2, 0.1])
    rows[1]["peak_step_error"] = 0.6
    figure = blank(6, 3)
    pattern_bars(figure, ranked(summary(*rows), top=None))
    ((mark,),) = (ax.texts for ax in figure.axes)
    assert (mark.get_text(), mark.xy) == ("i", (0.1, 0))
    assert legend_of(figure) == ["coarse steps"]
