"""The moving picture of a crush."""

import numpy as np
import pytest
from PIL import Image

from sweep.report.figures import case_plots
from sweep.report.figures.animation import REST, STEP, moment, write_gif
from tests.support.results.specimens import squeezed_cell, summary, there_and_back

ROW = summary({}).iloc[0]


def at(k, frames=None, row=ROW):
    figure = case_plots.blank(8.0, 4.2)
    moment(figure, row, frames or squeezed_cell(), there_and_back(), k)
    return figure.axes


@pytest.mark.parametrize("k", [0, 3, 7])
def test_dot_is_at_the_time_of_the_shape(k):
    """Shapes are 10 ms apart, the 41 rows 1 ms."""
    _, ax = at(k)
    whole, so_far, dot = ax.lines
    row = min(10 * k, 40)
    history = there_and_back()
    assert dot.get_xdata() == [100.0 * history["strain"][row]]
    assert dot.get_ydata() == [history["reaction_top_N"][row]]
    assert (len(whole.get_xdata()), len(so_far.get_xdata())) == (41, row + 1)


def test_all_shapes_have_one_view():
    views = [(ax.get_xlim(), ax.get_ylim()) for ax in (at(k)[0] for k in range(8))]
    assert {*views} == {views[0]}
    (left, right), (below, top) = views[0]
    assert left < -0.5 < 10.5 < right
    assert below < -0.5 < 10.5 < top


def test_custom_structure_shows_its_reactions():
    row = summary({"loading_mode": "custom"}).iloc[0]
    history = there_and_back().assign(probe_3_reaction_x_N=2.0)
    for told, place in {"time, ms": 30.0, "load factor": 0.75}.items():
        figure = case_plots.blank(8.0, 4.2)
        moment(figure, row, squeezed_cell(platens=False), history, 3)
        ax = figure.axes[1]
        assert ax.get_xlabel() == told
        assert [text.get_text() for text in ax.get_legend().get_texts()] == ["x at node 3", "floor"]
        assert ax.lines[-1].get_xdata() == pytest.approx([place, place])
        history["load_factor"] = history["time_s"] / 0.04


def test_gif_shows_the_shapes_that_stand_and_rests_on_the_last(tmp_path):
    path = tmp_path / "crush.gif"
    frames = squeezed_cell(heights=(10.0, 7.0, 4.0, 4.0))
    frames["position_m"][3, :, 1] += 12e-3  # it has flown off
    write_gif(path, ROW, frames, there_and_back())
    with Image.open(path) as moving:
        shown, pictures = [], []
        for k in range(moving.n_frames):
            moving.seek(k)
            shown.append(moving.info["duration"])
            pictures.append(np.asarray(moving.convert("RGB"), float))
        assert moving.info["loop"] == 0
    assert shown == [STEP, STEP, REST]
    walls = [(picture[:, :250].sum(axis=2) < 300.0).any(axis=1) for picture in pictures]
    tops = [np.flatnonzero(rows[80:]).min() for rows in walls]  # below the title
    assert tops == sorted(tops)
    assert tops[2] > tops[0] + 40
