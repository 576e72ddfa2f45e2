"""Pictures: what they show is what the numbers say."""

import numpy as np
import pytest
from matplotlib.colors import to_rgba
from specimens import HEIGHT, T, designs, squeezed_cell, summary, there_and_back

from sweep import plots
from sweep.rank import rank


@pytest.fixture
def row():
    return {
        "loading_mode": "displacement",
        "height_m": HEIGHT,
        "width_m": 10e-3,
        "depth_m": 10e-3,
        "wall_thickness_m": T,
        "plateau_stress_Pa": 0.2e6,
        "densification_strain": 0.3,
        "absorbed_energy_J": 0.096,
        "specific_absorption_J_per_g": 0.1,
        "peak_strain": 0.4,
    }


def axes_of(draw, *arguments):
    ax = plots.blank(4, 3).subplots()
    draw(ax, *arguments)
    return ax


def test_shaded_area_is_the_absorbed_energy(row):
    history = there_and_back()
    ax = axes_of(plots.force_displacement, history, row)
    x, y = ax.collections[0].get_paths()[0].vertices.T
    area = 0.5 * abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1)))  # percent x newton
    assert area / 100 * HEIGHT == pytest.approx(history["work_in_J"].max())
    assert "96 mJ" in ax.get_title("left")


def test_way_down_and_way_back_are_told_apart(row):
    ax = axes_of(plots.force_displacement, there_and_back(), row)
    lines = {line.get_label(): line for line in ax.get_lines()}
    down, back = lines["loading"], lines["unloading"]
    assert down.get_xdata()[-1] == back.get_xdata()[0] == pytest.approx(40.0)
    assert down.get_color() != back.get_color()
    assert down.get_linestyle() != back.get_linestyle()


def test_plateau_is_the_mean_force_up_to_densification(row):
    ax = axes_of(plots.force_displacement, there_and_back(), row)
    dotted = next(line for line in ax.get_lines() if line.get_linestyle() == ":")
    assert dotted.get_xdata()[-1] == pytest.approx(30.0)
    assert dotted.get_ydata()[0] == pytest.approx(0.2e6 * 11e-3 * 10e-3)


def test_plateau_of_a_dead_load_is_not_drawn(row):
    ax = axes_of(plots.force_displacement, there_and_back(), row | {"loading_mode": "force"})
    assert [line.get_linestyle() for line in ax.get_lines()] == ["--", "-"]


@pytest.mark.parametrize(("mode", "end"), [("displacement", 8.0), ("force", 40.0)])
def test_energies_add_up_to_the_work(row, mode, end):
    history = there_and_back()
    ax = axes_of(plots.energies, history, row | {"loading_mode": mode})
    top = max(stack.get_paths()[0].vertices[:, 1].max() for stack in ax.collections)
    assert top == pytest.approx(1e3 * history["work_in_J"].max())
    work = next(line for line in ax.get_lines() if line.get_label() == "work done")
    assert work.get_xdata()[-1] == pytest.approx(end)


def test_negligible_energies_have_no_colour(row):
    ax = axes_of(plots.energies, there_and_back(), row)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == ["work done", "lost to friction", "bending"]


def test_six_shapes_at_even_strains_and_the_last_one():
    figure = plots.blank(12, 3)
    plots.deformed_shapes(figure, squeezed_cell())
    titles = [ax.get_title() for ax in figure.axes]
    assert titles == ["0 %", "10 %", "20 %", "40 %", "50 %", "0 %"]


def test_six_shapes_at_even_times():
    figure = plots.blank(12, 3)
    plots.deformed_shapes(figure, squeezed_cell(), times=True)
    times = [ax.get_title().split("\n")[1] for ax in figure.axes]
    assert times == ["0 ms", "10 ms", "30 ms", "40 ms", "60 ms", "70 ms"]


def test_a_specimen_that_jumps_is_drawn_while_it_stands():
    figure = plots.blank(12, 3)
    frames = squeezed_cell(heights=(10.0, 9.0, 5.0, 5.0, 10.0, 30.0, 90.0))
    plots.deformed_shapes(figure, frames, times=True)
    strains = [ax.get_title().split("\n")[0] for ax in figure.axes]
    assert strains == ["0 %", "10 %", "50 %", "50 %", "0 %"]


def test_walls_are_as_thick_as_they_are_in_millimetres():
    figure = plots.blank(12, 3)
    plots.deformed_shapes(figure, squeezed_cell())
    ax = figure.axes[0]
    walls, lower, upper = ax.patches
    box = walls.get_path().get_extents()
    assert box.bounds == pytest.approx((-0.5, -0.5, 11.0, 11.0))
    assert lower.get_y() + lower.get_height() == pytest.approx(-0.5)
    assert upper.get_y() == pytest.approx(10.5)
    assert ax.get_aspect() == 1.0


def test_without_platens_only_the_ground_is_drawn():
    figure = plots.blank(12, 3)
    plots.deformed_shapes(figure, squeezed_cell(platens=False))
    assert [len(ax.patches) for ax in figure.axes] == [2] * 6


@pytest.fixture
def ranking():
    rows = designs([1.0, 2.0, 3.0], [0.1, 0.3, 0.2])
    for row, wall in zip(rows, [0.4e-3, 0.8e-3, 1.2e-3], strict=True):
        row["wall_thickness_m"] = wall
    glued = summary(*rows, *[row | {"platen": "contact"} for row in rows])
    return rank(glued, top=None)


def test_map_has_a_panel_a_scene_and_rings_round_the_pareto_front(ranking):
    figure = plots.blank(8, 4)
    plots.absorption_map(figure, ranking)
    assert [ax.get_title("left") for ax in figure.axes] == list(ranking["scene"].unique())
    rings = figure.axes[0].collections[-1]
    np.testing.assert_allclose(rings.get_offsets(), [[1.0, 0.1], [2.0, 0.3]])


def test_trend_follows_the_wall_thickness(ranking):
    figure = plots.blank(8, 4)
    plots.thickness_trends(figure, ranking)
    line = figure.axes[0].get_lines()[0]
    np.testing.assert_allclose(line.get_xdata(), [0.4, 0.8, 1.2])
    np.testing.assert_allclose(line.get_ydata(), [0.1, 0.15, 0.2 / 3.0])


def test_families_keep_their_colour_in_every_panel(ranking):
    wide = ranking.assign(cells_x=[2, 3, 4, 3, 4, 2])
    wide.attrs = ranking.attrs
    figure = plots.blank(8, 4)
    plots.absorption_map(figure, wide)
    colors = [
        {dots.get_label(): to_rgba(dots.get_facecolor()[0]) for dots in ax.collections[:3]}
        for ax in figure.axes
    ]
    assert colors[0] == colors[1]
    assert len(set(colors[0].values())) == 3


def test_pictures_are_png_files(tmp_path):
    figure = plots.blank(12, 6)
    plots.winners(figure, {"one": squeezed_cell(), "two": squeezed_cell(platens=False)})
    path = plots.save(figure, tmp_path / "new" / "shapes.png")
    assert path.read_bytes().startswith(b"\x89PNG")
