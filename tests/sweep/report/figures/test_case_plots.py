"""Pictures show what the numbers say."""

import numpy as np
import pandas
import pytest

from sweep.numbers import energy_text
from sweep.report.figures import case_plots, storyboard
from tests.support.results.specimens import (
    HEIGHT,
    T,
    squeezed_cell,
    summary,
    there_and_back,
    under_dead_load,
)


@pytest.fixture
def row():
    (row,) = summary(
        {
            "height_m": HEIGHT,
            "wall_thickness_m": T,
            "outer_width_m": 10e-3 + T,
            "stroke_m": 4e-3,
            "densification_strain": 0.31,
            "packing_strain": 0.3,
            "absorbed_energy_J": 0.096,
            "absorbed_energy_until_packed_J": 0.066,
            "returned_energy_J": 0.048,
            "peak_strain": 0.4,
        }
    ).to_dict("records")
    return row


@pytest.fixture
def dead(row):
    return row | {"loading_mode": "force", "force_N": 20.0, "stroke_m": np.nan}


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


def test_shaded_area_is_the_absorbed_energy(row):
    history = there_and_back()
    ax = axes_of(case_plots.force_displacement, history, row)
    assert area(ax.collections[0]) == pytest.approx(history["work_in_J"].max())
    assert labels(ax)[0] == "absorbed energy\n96.0 mJ, 0.0960 J/g"


def test_a_pause_is_neither_loading_nor_unloading(row):
    once = there_and_back()
    held = pandas.concat([once[:21], *[once[20:21]] * 5, once[21:]], ignore_index=True)
    held.loc[20:25, "reaction_top_N"] = np.linspace(100.0, 60.0, 6)
    ax = axes_of(case_plots.force_displacement, held, row)
    down, pause, back = ax.get_lines()[:3]
    assert list(pause.get_ydata()) == pytest.approx(np.linspace(100.0, 60.0, 6))
    assert [len(line.get_xdata()) for line in (down, back)] == [21, 21]
    assert labels(ax)[1:4] == ["loading", "hold", "unloading,\nreturns 50 %"]


def test_further_cycles_have_a_line_of_their_own(row):
    once = there_and_back()
    thrice = pandas.concat([once, once[1:], once[1:]], ignore_index=True)
    ax = axes_of(case_plots.force_displacement, thrice, row)
    down, back, again = ax.get_lines()[:3]
    lengths = [len(line.get_xdata()) for line in (down, back, again)]
    assert lengths == [21, 21, 81]
    assert again.get_xdata()[0] == back.get_xdata()[-1] == 0.0
    assert labels(ax)[3] == "further cycles"


def test_the_area_below_the_mean_force_is_the_energy_until_packed(row):
    ax = axes_of(case_plots.force_displacement, there_and_back(), row)
    dotted = next(line for line in ax.get_lines() if line.get_linestyle() == ":")
    assert dotted.get_xdata()[-1] == pytest.approx(30.0)
    assert dotted.get_ydata()[0] == pytest.approx(0.066 / (0.3 * HEIGHT))
    counted = "usable until densification\nat 30 %: 66.0 mJ, 0.0660 J/g,\nmean force 22.0 N"
    assert labels(ax)[-1] == counted


def test_what_has_not_packed_is_told(row):
    never = row | {"densification_strain": np.nan}
    ax = axes_of(case_plots.force_displacement, there_and_back(), never)
    counted = "no densification; usable to 30 %: 66.0 mJ, 0.0660 J/g,\nmean force 22.0 N"
    assert labels(ax)[-1] == counted
    older = row | {"packing_strain": np.nan, "absorbed_energy_until_packed_J": np.nan}
    ax = axes_of(case_plots.force_displacement, there_and_back(), older)
    assert ":" not in [line.get_linestyle() for line in ax.get_lines()]


def test_dead_load_comes_and_goes_in_a_step(dead):
    history = under_dead_load()
    ax = axes_of(case_plots.force_displacement, history, dead)
    on, off = ax.get_lines()[:2]
    assert {on.get_drawstyle(), off.get_drawstyle()} == {"steps-pre"}
    assert on.get_ydata()[-1] == off.get_ydata()[0] == 20.0
    assert off.get_ydata()[-1] == 0.0
    assert area(ax.collections[0]) == pytest.approx(history["work_in_J"].max())
    assert labels(ax)[1:] == ["load applied", "load removed"]


def test_an_area_that_is_not_the_absorbed_energy_has_its_own_number(dead):
    """A plate on loose walls falls farther than the rows of nodes come closer."""
    history = under_dead_load()
    below = history["work_in_J"].max()
    more = dead | {"absorbed_energy_J": 1.5 * below}
    for row in (dead | {"absorbed_energy_J": below}, more):
        ax = axes_of(case_plots.force_displacement, history, row)
        first, *_ = labels(ax)
        assert first.startswith("absorbed energy\n" if row is not more else "force x shortening\n")
        assert energy_text(area(ax.collections[0])) in first
    assert f"absorbed energy\n{energy_text(1.5 * below)}" in first


def test_energies_add_up_to_the_work_along_the_path_of_the_platen(row):
    history = there_and_back()
    ax = axes_of(case_plots.energies, history, row)
    top = max(stack.get_paths()[0].vertices[:, 1].max() for stack in ax.collections)
    assert top == pytest.approx(1e3 * history["work_in_J"].max())
    turn, work = ax.get_lines()
    assert turn.get_xdata()[0] == pytest.approx(4.0)
    assert work.get_xdata()[-1] == pytest.approx(8.0)


@pytest.mark.parametrize(("times", "unit", "factor"), [(1.0, "mJ", 1e3), (1e4, "J", 1.0)])
def test_energies_have_a_unit_of_their_size(row, times, unit, factor):
    history = there_and_back()
    history[[*storyboard.PARTS, "work_in_J"]] *= times
    ax = axes_of(case_plots.energies, history, row)
    assert ax.get_ylabel() == f"energy, {unit}"
    line = ax.get_lines()[-1]
    assert line.get_ydata().max() == pytest.approx(factor * history["work_in_J"].max())


def test_what_time_integration_gains_is_added_to_the_work(dead):
    history = under_dead_load()
    history = history.assign(**dict.fromkeys(storyboard.PARTS, 0.0))
    history["stretch_J"] = 1.1 * history["work_in_J"]
    history["dissipated_integrator_J"] = -0.1 * history["work_in_J"]
    ax = axes_of(case_plots.energies, history, dead)
    line = ax.get_lines()[-1]
    np.testing.assert_allclose(line.get_ydata(), 1.1e3 * history["work_in_J"])
    assert line.get_label().endswith(" + gained in load or time steps")
    top = max(stack.get_paths()[0].vertices[:, 1].max() for stack in ax.collections)
    assert top == pytest.approx(line.get_ydata().max())


def test_every_turn_of_the_platen_is_marked(row):
    once = there_and_back()
    twice = pandas.concat([once, once[1:]], ignore_index=True)
    ax = axes_of(case_plots.energies, twice, row)
    *marks, work = ax.get_lines()
    assert [line.get_xdata()[0] for line in marks] == pytest.approx([4.0, 8.0, 12.0])
    assert work.get_xdata()[-1] == pytest.approx(16.0)
    assert [text.get_text() for text in ax.texts] == ["reversal", "cycle 2", "reversal"]
    halted = axes_of(case_plots.energies, twice[:31], row)
    assert [text.get_text() for text in halted.texts] == ["reversal"]


def test_energies_under_a_dead_load_are_drawn_over_time(dead):
    ax = axes_of(case_plots.energies, under_dead_load(), dead)
    release, work = ax.get_lines()
    assert release.get_xdata()[0] == pytest.approx(20.0)
    assert work.get_xdata()[-1] == pytest.approx(40.0)
    assert [text.get_text() for text in ax.texts] == ["load removed"]


def test_walls_are_as_thick_as_they_are_in_millimetres():
    figure = case_plots.blank(12, 3)
    case_plots.deformed_shapes(figure, "", squeezed_cell())
    ax = figure.axes[0]
    walls, lower, upper = ax.patches
    box = walls.get_path().get_extents()
    assert box.bounds == pytest.approx((-0.5, -0.5, 11.0, 11.0))
    assert lower.get_y() + lower.get_height() == pytest.approx(-0.5)
    assert upper.get_y() == pytest.approx(10.5)
    assert ax.get_aspect() == 1.0


def test_without_platens_only_the_ground_is_drawn():
    figure = case_plots.blank(12, 3)
    case_plots.deformed_shapes(figure, "", squeezed_cell(platens=False))
    assert [len(ax.patches) for ax in figure.axes] == [2] * 6


def test_a_striker_and_ribs_are_drawn_where_the_platens_are():
    """The outlines in place of both rectangles, at the heights of the platens."""
    square = 1e-3 * np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    frames = squeezed_cell() | {"striker_m": square, "base_m": np.concatenate([square, square])}
    figure = case_plots.blank(8.0, 3.0)
    case_plots.deformed_shapes(figure, "", frames)
    assert [len(ax.patches) for ax in figure.axes] == [4] * len(figure.axes)
    *_, lower, upper = figure.axes[0].patches[1:]
    assert lower.get_xy()[:, 1].min() == pytest.approx(1e3 * frames["plate_y_m"][0, 0])
    assert upper.get_xy()[:, 1].min() == pytest.approx(1e3 * frames["plate_y_m"][0, 1])


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
