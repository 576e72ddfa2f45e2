"""Pictures show what the numbers say."""

import numpy as np
import pandas
import pytest

from sweep.numbers import energy_text
from sweep.report.figures import case_plots, storyboard
from tests.support.results.specimens import (
    HEIGHT,
    squeezed_cell,
    summary,
    there_and_back,
    under_dead_load,
)

ROW = summary(
    {
        "height_m": HEIGHT,
        "stroke_m": 4e-3,
        "densification_strain": 0.31,
        "packing_strain": 0.3,
        "absorbed_energy_J": 0.096,
        "absorbed_energy_until_packed_J": 0.066,
        "returned_energy_J": 0.048,
        "peak_strain": 0.4,
    }
).to_dict("records")[0]
DEAD = ROW | {"loading_mode": "force", "force_N": 20.0, "stroke_m": np.nan}


def axes_of(draw, *arguments):
    ax = case_plots.blank(4, 3).subplots()
    draw(ax, *arguments)
    return ax


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def area(filled):
    """Area in J that is filled in a diagram of N over % of the height."""
    x, y = filled.get_paths()[0].vertices.T
    return 0.5 * abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1))) / 100 * HEIGHT


def test_shaded_area_is_the_absorbed_energy_and_below_the_mean_force_until_packed():
    history = there_and_back()
    ax = axes_of(case_plots.force_displacement, history, ROW)
    assert area(ax.collections[0]) == pytest.approx(history["work_in_J"].max())
    assert labels(ax)[0] == "absorbed energy\n96.0 mJ, 0.0960 J/g"
    dotted = next(line for line in ax.get_lines() if line.get_linestyle() == ":")
    assert dotted.get_xdata()[-1] == pytest.approx(30.0)
    assert dotted.get_ydata()[0] == pytest.approx(0.066 / (0.3 * HEIGHT))
    assert "until densification\nat 30 %: 66.0 mJ, 0.0660 J/g,\nmean force 22.0 N" in labels(ax)[-1]


def test_a_pause_and_further_cycles_have_lines_of_their_own():
    once = there_and_back()
    held = pandas.concat([once[:21], *[once[20:21]] * 5, once[21:], once[1:]], ignore_index=True)
    held.loc[20:25, "reaction_top_N"] = np.linspace(100.0, 60.0, 6)
    ax = axes_of(case_plots.force_displacement, held, ROW)
    down, pause, back, again = ax.get_lines()[:4]
    assert list(pause.get_ydata()) == pytest.approx(np.linspace(100.0, 60.0, 6))
    assert [len(line.get_xdata()) for line in (down, back, again)] == [21, 21, 41]
    assert again.get_xdata()[0] == back.get_xdata()[-1] == 0.0
    said = ["loading", "hold", "unloading,\nreturns 50 %", "further cycles"]
    assert labels(ax)[1:5] == said


def test_a_lattice_that_a_platen_pulls_back_returns_nothing():
    row = ROW | {"returned_energy_J": -0.01}
    ax = axes_of(case_plots.force_displacement, there_and_back(), row)
    assert "unloading,\npulled back" in labels(ax)


def test_what_has_not_packed_is_told():
    never = ROW | {"densification_strain": np.nan}
    ax = axes_of(case_plots.force_displacement, there_and_back(), never)
    assert "no densification; usable to 30 %: 66.0 mJ" in labels(ax)[-1]
    older = ROW | {"packing_strain": np.nan, "absorbed_energy_until_packed_J": np.nan}
    ax = axes_of(case_plots.force_displacement, there_and_back(), older)
    assert ":" not in [line.get_linestyle() for line in ax.get_lines()]


def test_dead_load_comes_and_goes_in_a_step():
    ax = axes_of(case_plots.force_displacement, under_dead_load(), DEAD)
    on, off = ax.get_lines()[:2]
    assert {on.get_drawstyle(), off.get_drawstyle()} == {"steps-pre"}
    assert on.get_ydata()[-1] == off.get_ydata()[0] == 20.0
    assert off.get_ydata()[-1] == 0.0
    assert labels(ax)[1:] == ["load applied", "load removed"]


def test_an_area_that_is_not_the_absorbed_energy_has_its_own_number():
    """A plate on loose walls falls farther than the rows of nodes come closer."""
    history = under_dead_load()
    below = history["work_in_J"].max()
    for factor, first in {1.0: "absorbed energy\n", 1.5: "force x shortening\n"}.items():
        row = DEAD | {"absorbed_energy_J": factor * below}
        ax = axes_of(case_plots.force_displacement, history, row)
        said = labels(ax)[0]
        assert said.startswith(first)
        assert energy_text(area(ax.collections[0])) in said
        assert f"absorbed energy\n{energy_text(factor * below)}" in said


def top_of(ax):
    return max(stack.get_paths()[0].vertices[:, 1].max() for stack in ax.collections)


@pytest.mark.parametrize(("times", "unit", "factor"), [(1.0, "mJ", 1e3), (1e4, "J", 1.0)])
def test_energies_add_up_to_the_work_along_the_path_of_the_platen(times, unit, factor):
    history = there_and_back()
    history[[*storyboard.PARTS, "work_in_J"]] *= times
    ax = axes_of(case_plots.energies, history, ROW)
    assert ax.get_ylabel() == f"energy, {unit}"
    assert top_of(ax) == pytest.approx(factor * history["work_in_J"].max())
    turn, work = ax.get_lines()
    assert work.get_ydata().max() == pytest.approx(top_of(ax))
    assert turn.get_xdata()[0] == pytest.approx(4.0)
    assert work.get_xdata()[-1] == pytest.approx(8.0)


def test_what_time_integration_gains_is_added_to_the_work():
    history = under_dead_load()
    history = history.assign(**dict.fromkeys(storyboard.PARTS, 0.0))
    history["stretch_J"] = 1.1 * history["work_in_J"]
    history["dissipated_integrator_J"] = -0.1 * history["work_in_J"]
    ax = axes_of(case_plots.energies, history, DEAD)
    line = ax.get_lines()[-1]
    np.testing.assert_allclose(line.get_ydata(), 1.1e3 * history["work_in_J"])
    np.testing.assert_allclose(line.get_xdata()[-1], 40.0)  # over time
    assert ax.get_lines()[0].get_xdata()[0] == pytest.approx(20.0)
    assert [text.get_text() for text in ax.texts] == ["load removed"]
    assert line.get_label().endswith(" + gained in load or time steps")
    assert top_of(ax) == pytest.approx(line.get_ydata().max())


def test_every_turn_of_the_platen_is_marked():
    once = there_and_back()
    twice = pandas.concat([once, once[1:]], ignore_index=True)
    ax = axes_of(case_plots.energies, twice, ROW)
    *marks, work = ax.get_lines()
    assert [line.get_xdata()[0] for line in marks] == pytest.approx([4.0, 8.0, 12.0])
    assert work.get_xdata()[-1] == pytest.approx(16.0)
    assert [text.get_text() for text in ax.texts] == ["reversal", "cycle 2", "reversal"]
    halted = axes_of(case_plots.energies, twice[:31], ROW)
    assert [text.get_text() for text in halted.texts] == ["reversal"]


def shapes_of(frames):
    figure = case_plots.blank(12, 3)
    case_plots.deformed_shapes(figure, "", frames)
    return figure.axes


def test_walls_are_as_thick_as_they_are_in_millimetres():
    ax = shapes_of(squeezed_cell())[0]
    walls, lower, upper = ax.patches
    box = walls.get_path().get_extents()
    assert box.bounds == pytest.approx((-0.5, -0.5, 11.0, 11.0))
    assert lower.get_y() + lower.get_height() == pytest.approx(-0.5)
    assert upper.get_y() == pytest.approx(10.5)
    assert ax.get_aspect() == 1.0
    on_the_ground = shapes_of(squeezed_cell(platens=False))
    assert [len(ax.patches) for ax in on_the_ground] == [2] * 6


def test_a_striker_and_ribs_are_drawn_where_the_platens_are():
    """The outlines in place of both rectangles, at the heights of the platens."""
    square = 1e-3 * np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    frames = squeezed_cell() | {"striker_m": square, "base_m": np.concatenate([square, square])}
    axes = shapes_of(frames)
    assert {len(ax.patches) for ax in axes} == {4}
    below = [outline.get_xy()[:, 1].min() for outline in axes[0].patches[2:]]
    assert below == pytest.approx(1e3 * frames["plate_y_m"][0])


@pytest.mark.parametrize(("height", "shown"), [(8.0, 8.0), (10.0, 10.0), (50.0, 10.0)])
def test_a_striker_is_shown_as_far_as_it_is_no_higher_than_the_lattice(height, shown):
    """In mm, above a lattice of 10 mm, with walls of 1 mm."""
    outline = 1e-3 * np.array([[0.0, 0.0], [height, height], [-height, height]])
    frames = squeezed_cell() | {"striker_m": outline}
    assert shapes_of(frames)[0].get_ylim()[1] == pytest.approx(11.0 + shown)


FLAT, TALL = [4.0, 3.8, 3.6, 3.4, 3.2], [40.0, 38.0, 36.0, 34.0, 32.0]


@pytest.mark.parametrize("heights", [FLAT, TALL])
def test_nothing_is_left_blank_between_shapes(heights):
    frames = squeezed_cell(heights=heights)
    figure = case_plots.blank(*case_plots.shapes_size("a cell", frames))
    case_plots.deformed_shapes(figure, "a cell", frames)
    figure.draw_without_rendering()
    boxes = [ax.get_window_extent() for ax in figure.axes]
    between = figure.bbox.width - sum(box.width for box in boxes)
    above_and_below = figure.bbox.height - boxes[0].height
    assert between < 0.15 * len(boxes) * figure.dpi  # inches
    assert above_and_below < 0.9 * figure.dpi  # a title, a caption, the scale bar


def test_winners_are_drawn_to_one_scale():
    figure = case_plots.blank(12, 6)
    cells = [squeezed_cell(heights=heights) for heights in (FLAT, TALL)]
    alone = [case_plots.shapes_scale(frames) for frames in cells]
    assert alone[0] > 1.1 * alone[1]
    case_plots.winners(figure, dict(zip(["flat", "tall"], cells, strict=True)))
    figure.draw_without_rendering()
    axes = [ax for strip in figure.subfigs for ax in strip.axes]
    scales = [ax.bbox.width / np.ptp(ax.get_xlim()) for ax in axes]
    np.testing.assert_allclose(scales, case_plots.FITS * alone[1] * figure.dpi)
    for strip in figure.subfigs:
        left, right = strip.axes[0].bbox, strip.axes[1].bbox
        assert left.x1 <= right.x0
        assert left.y1 < strip.bbox.y1


def test_names_are_no_formulas(tmp_path):
    figure = case_plots.blank(4.0, 3.0)
    axes = figure.subplots()
    axes.loglog([1.0, 1e6], [1.0, 1e6], label="$x^{2$ is no formula")
    axes.set_title("tpu $5 and $6")
    axes.legend()
    case_plots.save(figure, tmp_path / "a.png")
    powers = [label for label in axes.get_xticklabels() if "10^" in label.get_text()]
    assert powers
    assert all(label.get_parse_math() for label in powers)
    assert not axes.title.get_parse_math()
