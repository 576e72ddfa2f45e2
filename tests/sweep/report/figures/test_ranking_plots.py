"""Charts of a ranking: every design at its place, the best of them marked."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex, to_rgb
from matplotlib.text import Text

from sweep.ranking.rank import ranked
from sweep.report.figures.case_plots import GREY, TICKS, blank, round_ticks
from sweep.report.figures.design_style import looks
from sweep.report.figures.pattern_bars import pattern_bars
from sweep.report.figures.ranking_plots import PALE, has_trends, merit_over_mass, thickness_trends
from tests.support.results.specimens import designs, summary

PAD = 10.0  # pixels between a panel and what is beside it


@pytest.fixture
def ranking():
    rows = designs([1.0, 2.0, 3.0], [0.1, 0.3, 0.2])
    walls = [0.4e-3, 0.8e-3, 1.2e-3] * 2
    table = summary(*rows, *(row | {"platen": "contact"} for row in rows))
    return ranked(table.assign(wall_thickness_m=walls), top=None)


def drawn(ranking, draw=merit_over_mass):
    figure = blank(8, 4)
    draw(figure, ranking)
    return figure


def changed(ranking, **columns):
    return replace(ranking, table=ranking.table.assign(**columns))


def is_text(artist):
    return artist.get_text() if isinstance(artist, Text) else ""


def bars_of(ax):
    lines = [c for c in ax.collections if isinstance(c, LineCollection)]
    return [segment for line in lines for segment in line.get_segments()]


def entries(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()]


def test_map_has_a_panel_a_scene_and_stairs_along_the_pareto_front(ranking):
    axes = drawn(ranking).axes
    scenes = [ax.get_title("left").splitlines()[0] for ax in axes]
    assert scenes == list(ranking.table["scene"].unique())
    stairs = axes[0].get_lines()[0]
    np.testing.assert_allclose(stairs.get_xydata(), [[1.0, 0.1], [2.0, 0.3]])
    assert stairs.get_drawstyle() == "steps-post"


@pytest.mark.parametrize("draw", [merit_over_mass, thickness_trends, pattern_bars])
@pytest.mark.parametrize("scenes", [1, 2])
def test_titles_stay_above_their_panels(ranking, draw, scenes):
    """Beside them is the legend, or the next panel."""
    scene = "struck by 1361 g at 4 m/s (10.9 J) on a target of 1361 g, striker round, 6 mm, at 50 %"
    table = ranking.table[ranking.table["scene"].isin(ranking.scenes[:scenes])]
    table = table.assign(scene=scene + ", " + table["scene"])
    table.loc[table.index[0], "lattice_kind"] = "reentrant"  # a wide legend
    figure = blank(5.0 * scenes + 1.8, 4.2)
    draw(figure, replace(ranking, table=table, budgets_g=(1.5, 3.0)))
    figure.draw_without_rendering()
    for ax in filter(lambda ax: ax.get_title("left"), figure.axes):
        (title,) = ax.findobj(lambda text, ax=ax: is_text(text) == ax.get_title("left"))
        assert title.get_window_extent().x1 <= ax.get_window_extent().x1 + PAD


def test_lines_are_named_by_their_cells_where_colours_show_patterns(ranking):
    kinds = ["hex", "hex", "square"] * 2
    several = changed(ranking, lattice_kind=kinds, cells_x=[3, 4, 3] * 2)
    for shown, names in ((several, ["3 x 3", "4 x 3", "3 x 3"]), (ranking, [])):
        (ax, _) = drawn(shown, thickness_trends).axes
        assert [text.get_text() for text in ax.texts] == names


def test_map_names_and_rings_the_winner_of_each_budget(ranking):
    ax = drawn(replace(ranking, budgets_g=(1.5, 3.0))).axes[0]
    said = ax.get_title("left").splitlines()[1:]
    assert said == ["up to 1.5 g: wall 0.4 mm, 100 mJ", "up to 3 g: wall 0.8 mm, 300 mJ"]
    assert [text.get_text() for text in ax.texts] == ["1.5 g", "3 g"]
    rings = [tuple(dots.get_offsets()[0]) for dots in ax.collections[-2:]]
    assert rings == [(1.0, 0.1), (2.0, 0.3)]


@pytest.mark.parametrize("draw", [merit_over_mass, thickness_trends])
def test_charts_say_what_is_required_and_up_to_which_force_energy_counts(ranking, draw):
    required = drawn(replace(ranking, required={"max_force": 60.0}), draw)
    said = required.axes[0].get_title("left").splitlines()[1:]
    assert said[0] == "Required of the part: force at most 60 N."
    table = summary(*designs([1.0, 2.0], [0.1, 0.3])).assign(absorbed_energy_at_50N_J=0.1)
    (ax,) = drawn(ranked(table, top=None, allowed_force="50 N"), draw).axes
    assert "\nuntil the force exceeds 50 N, J" in ax.get_ylabel()


def test_force_of_a_panel_stands_beside_that_of_a_specimen():
    hit = {"loading_mode": "impact", "stroke_m": np.nan, "peak_force_N": 30.0}
    (ax,) = drawn(ranked(summary(hit, hit), panel=("130 mm", "50 mm"), top=None)).axes
    assert "30.0 N on the support, 1500 N on the panel" in ax.get_title("left")
    assert ax.get_ylabel() == "greatest force on the support, filtered, N, of a specimen"


def test_map_of_a_dead_load_shows_how_far_it_sinks(ranking):
    loaded = changed(ranking, loading_mode="force", peak_strain=[0.3, 0.2, 0.1] * 2)
    ax = drawn(loaded).axes[0]
    assert ax.get_ylabel() == "greatest strain, %"
    sinks = [y for dots in ax.collections[:2] for _, y in dots.get_offsets()]
    np.testing.assert_allclose(sorted(sinks), [10.0, 20.0, 30.0])


@pytest.mark.parametrize(("patterns", "cells"), [(8, 3), (12, 20)])
def test_legends_stay_on_the_page(patterns, cells):
    rows = [
        {"lattice_kind": f"pattern {k}", "cells_x": n + 2, "wall_thickness_m": (4 + n) * 1e-4}
        for k in range(patterns)
        for n in range(cells)
    ]
    figure = blank(6.8, 4.2)
    merit_over_mass(figure, ranked(summary(*rows), top=None))
    figure.draw_without_rendering()
    (legend,) = figure.legends
    page, box = figure.bbox, legend.get_window_extent()
    assert page.x0 <= box.x0 < box.x1 <= page.x1
    assert page.y0 <= box.y0 < box.y1 <= page.y1
    assert figure.axes[0].bbox.width > 0.3 * 6.8 * figure.dpi


def test_designs_beyond_the_model_are_open(ranking):
    beyond = changed(ranking, beyond_model=ranking.table["wall_thickness_m"] > 1e-3)
    for dots in drawn(beyond).axes[0].collections[:2]:
        is_open = (dots.get_facecolor() == 1.0).all(axis=1)
        np.testing.assert_array_equal(is_open, dots.get_offsets()[:, 0] == 3.0)


def test_designs_of_coarse_steps_have_the_sign_of_the_tables(ranking):
    shown = changed(ranking, loading_mode="force", peak_strain=0.1, coarse=[True, False, True] * 2)
    figure = drawn(shown, merit_over_mass)
    signs = [text.xy[0] for text in figure.axes[0].texts if text.get_text() == "i"]
    coarse = shown.table[shown.table["coarse"] & (shown.table["scene"] == shown.table["scene"][0])]
    assert sorted(signs) == sorted(coarse["mass_g"])
    for draw in (merit_over_mass, thickness_trends):
        assert "coarse steps" in entries(drawn(shown, draw))
    assert "coarse steps" not in entries(drawn(ranking, merit_over_mass))
    assert not drawn(ranking, thickness_trends).legends


def test_designs_off_the_front_are_pale_and_those_above_all_budgets_grey(ranking):
    figure = drawn(replace(ranking, budgets_g=(2.5,)))
    colors = {
        x: to_hex(face)
        for dots in figure.axes[0].collections[:2]
        for x, face in zip(dots.get_offsets()[:, 0], dots.get_facecolor(), strict=True)
    }
    (own,) = looks(ranking.table).colors.values()
    assert colors == {1.0: own, 2.0: own, 3.0: pale(GREY)}
    assert entries(figure)[-3:] == ["Pareto front; others pale", "best", "above all budgets"]
    figure = drawn(ranking)
    assert entries(figure)[-2:] == ["Pareto front; others pale", "best"]
    assert to_hex(figure.axes[0].collections[0].get_facecolor()[0]) == pale(own)


def pale(color):
    return to_hex(PALE * np.array(to_rgb(color)) + (1.0 - PALE))


@pytest.mark.parametrize(
    ("draw", "x", "y"),
    [
        (merit_over_mass, [1.0, 2.0], [0.1, 0.3]),
        (thickness_trends, [0.4, 0.8, 1.2], [0.1, 0.15, 0.2 / 3.0]),
    ],
)
def test_lines_are_dashed_to_and_from_what_is_not_to_be_trusted(ranking, draw, x, y):
    crossed = ranking.table["wall_thickness_m"].between(0.7e-3, 0.9e-3)
    solid, dashed = drawn(changed(ranking, crossed=crossed), draw).axes[0].get_lines()
    assert (solid.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    np.testing.assert_allclose(dashed.get_xydata(), np.column_stack([x, y]))
    np.testing.assert_allclose(solid.get_ydata(), [y[0], np.nan, *y[2:]])
    assert solid.get_drawstyle() == dashed.get_drawstyle()


def test_designs_have_their_error_bars_which_end_above_zero(ranking):
    assert not any(map(bars_of, drawn(ranking).axes))
    error = f"error_{ranking.energy}"
    figure = drawn(changed(ranking, **{error: [0.01, 0.5, np.nan] * 2}))
    ends = [bar[:, 1] for bar in bars_of(figure.axes[0])]
    best, second = ranking.table["absorbed_energy_J"][:2]
    np.testing.assert_allclose(ends, [[best - 0.01, best + 0.01], [0.1 * second, second + 0.5]])
    assert "± estimated error" in entries(figure)
    assert "± estimated error" not in entries(drawn(ranking))
    wild = changed(ranking, **{error: 1e6})
    assert drawn(wild).axes[0].get_ylim()[1] < 100.0 * best


def test_trends_and_patterns_have_the_error_bars_of_energy_per_gram(ranking):
    sure = changed(ranking, **{f"error_{ranking.per_gram}": 0.02})
    for draw, across in ((thickness_trends, 1), (pattern_bars, 0)):
        widths = [np.ptp(bar[:, across]) for bar in bars_of(drawn(sure, draw).axes[0])]
        np.testing.assert_allclose(widths, [0.04] * 3)


@pytest.mark.parametrize("view", [(1e-6, 1.0), (0.05, 30.0), (0.8, 2.2), (0.9, 1.02), (38.0, 71.0)])
def test_a_log_axis_has_enough_round_labels_and_not_too_many(view):
    ax = blank(4, 3).subplots()
    ax.set(xscale="log", xlim=view)
    round_ticks(ax.xaxis)
    seen = [tick for tick in ax.get_xticks() if view[0] <= tick <= view[1]]
    assert TICKS <= len(seen) <= 3 * TICKS
    np.testing.assert_allclose(seen, [float(f"{tick:.3g}") for tick in seen], rtol=1e-9)


def test_designs_that_all_weigh_the_same_have_an_axis():
    rows = designs([1.4, 1.4 + 1e-14, 1.4 - 1e-14], [0.1, 0.3, 0.2])
    axis = drawn(ranked(summary(*rows), top=None)).axes[0].xaxis
    low, high = axis.get_view_interval()
    assert 1.1 < high / low < 2.0
    assert low < 1.4 < high
    assert 2 < np.sum((axis.get_ticklocs() >= low) & (axis.get_ticklocs() <= high)) < 12


def test_trends_are_of_one_pattern_each(ranking):
    table = ranking.table
    assert has_trends(table)
    table["lattice_kind"] = ["square", "hex", "square"] * 2
    assert has_trends(table)
    lines = drawn(ranking, thickness_trends).axes[0].get_lines()
    assert sorted(len(line.get_xdata()) for line in lines) == [1, 2]
    table["lattice.grading"] = [1.0, 1.0, 2.0] * 2
    assert not has_trends(table)
    assert not has_trends(table.head(0))
