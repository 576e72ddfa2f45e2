"""Energy-absorption diagrams and cushion curves of two designs whose crushes are known."""

import numpy as np
import pytest

from sweep.constants import STANDARD_GRAVITY
from sweep.ranking.cushion import Crush, cushion_curve, drops
from sweep.ranking.rank import ranked
from sweep.report.figures.case_plots import blank
from sweep.report.figures.cushion_plots import (
    absorption_diagram,
    cushion_diagram,
    envelope,
    same_design,
)
from tests.support.results.specimens import summary

STRAIN = np.linspace(0.001, 0.6, 600)
SPEED = (2.0 * STANDARD_GRAVITY * 0.5) ** 0.5  # of a fall from 0.5 m
HIT = {
    "loading_mode": "impact",
    "striker_mass_g": 40.0,
    "striker_speed_m_per_s": SPEED,
    "gravity": 1.0,
    "peak_deceleration_filtered_m_per_s2": 60.0 * STANDARD_GRAVITY,
}
WALLS = {"wall_thickness_m": 0.4e-3, "lattice.wall_thickness": 0.4e-3, "mass_g": 0.5}


def foam(stress):
    """Constant stress (Pa) up to 50 % strain, where the energy is half the stress; then a rise."""
    rise = 4.0 * stress * (STRAIN - 0.5).clip(0.0)
    work = np.append(0.0, np.cumsum(stress + 0.5 * (rise[1:] + rise[:-1]))) * 1e-3 + stress * 1e-3
    return Crush(STRAIN, stress + rise, work, 12.2e-3)


@pytest.fixture
def designs():
    thick = {"wall_thickness_m": 0.8e-3, "lattice.wall_thickness": 0.8e-3}
    table = ranked(summary(thick, WALLS, thick | HIT, WALLS | HIT, thick | HIT), top=None).table
    return table.sort_values("case_id")


def crushed(designs):
    rows = designs[designs["loading_mode"] == "displacement"]
    return rows, {name: foam(s) for name, s in zip(rows["case_id"], (20e3, 5e3), strict=True)}


def absorption_of(designs, **columns):
    rows, crushes = crushed(designs)
    figure = blank(8, 4)
    absorption_diagram(figure, rows.assign(**columns), crushes)
    return figure


def cushions(designs, height=0.5, falls=None):
    rows, crushes = crushed(designs)
    figure = blank(8, 4)
    impacts = designs[designs["loading_mode"] == "impact"]
    cushion_diagram(figure, rows, crushes, height, drops(impacts.assign(**(falls or {}))))
    return figure


def test_the_diagram_has_a_curve_and_a_shoulder_for_each_design(designs):
    rows, crushes = crushed(designs)
    (ax,) = absorption_of(designs).axes
    thick, thin, most = ax.get_lines()
    np.testing.assert_allclose(thick.get_ydata(), crushes[rows["case_id"].iloc[0]].work / 12e6)
    assert thick.get_linewidth() > thin.get_linewidth()
    shoulders = np.array([dots.get_offsets()[0] for dots in ax.collections])
    np.testing.assert_allclose(shoulders * 12e6, [[20e3, 10e3], [5e3, 2.5e3]], rtol=0.02)
    assert most.get_ydata().max() == pytest.approx(thick.get_ydata().max())
    assert ax.get_xlabel() == "greatest stress / modulus"


@pytest.mark.parametrize("draw", [absorption_of, cushions])
def test_walls_are_lines_in_the_legend_as_thick_as_their_curves(designs, draw):
    figure = draw(designs)
    thick, thin = figure.axes[0].get_lines()[:2]
    entries = {entry.get_label(): entry for entry in figure.legends[0].legend_handles}
    for label, curve in {"0.8 mm": thick, "0.4 mm": thin}.items():
        entry = entries[label]
        assert (entry.get_linestyle(), entry.get_marker()) == ("-", "")
        assert entry.get_linewidth() == curve.get_linewidth()


def test_without_the_modulus_of_every_design_nothing_is_divided(designs):
    (ax,) = absorption_of(designs, material_modulus_Pa=[np.nan, 12e6]).axes
    assert ax.get_xlabel() == "greatest stress, kPa"
    assert ax.get_lines()[0].get_xdata()[0] == pytest.approx(20.0)


def test_the_envelope_is_of_the_softest_until_a_stiffer_absorbs_more():
    """It is zero up to 5 kPa; the soft foam has all its energy from 7 kPa on, the other from 20 kPa
    on.
    """
    soft, stiff = foam(5e3), foam(20e3)
    stresses, most = envelope([stiff, soft])
    between = (stresses > 7.5e3) & (stresses < 20e3)
    np.testing.assert_allclose(most[between], soft.work[-1])
    np.testing.assert_allclose(most[-1], stiff.work[-1])
    assert np.all(np.diff(most) >= 0.0)


def test_cushion_curves_have_the_impacts_of_their_design_beside(designs):
    rows, crushes = crushed(designs)
    figure = cushions(designs)
    (ax,) = figure.axes
    assert ax.get_title("left").endswith(",\ndropped from 0.5 m")
    static, peak = cushion_curve(crushes[rows["case_id"].iloc[0]], 0.5)
    drawn = ax.get_lines()[0].get_xydata()
    np.testing.assert_allclose(drawn, np.column_stack([1e-3 * static, peak]))
    assert [len(dots.get_offsets()) for dots in ax.collections] == [1, 2, 1, 1]
    ring = ax.collections[1].get_offsets()[0]
    assert list(ring) == pytest.approx([1e-3 * 40e-3 * STANDARD_GRAVITY / (13e-3 * 10e-3), 60.0])
    assert last_label(figure) == "simulated impact"


def last_label(figure):
    return figure.legends[0].get_texts()[-1].get_text()


def test_impacts_far_above_the_curves_are_in_view_and_from_another_height_not_drawn(designs):
    hard = {"peak_deceleration_filtered_m_per_s2": 1e5 * STANDARD_GRAVITY}
    assert cushions(designs, falls=hard).axes[0].get_ylim()[1] > 1e5
    figure = cushions(designs, 1.0)
    assert last_label(figure) != "simulated impact"
    assert sum(len(dots.get_offsets()) for dots in figure.axes[0].collections) == 2


def test_a_design_is_the_same_under_another_loading_only(designs):
    design = designs.iloc[0]
    others = designs[2:].assign(**{"loading.mode": "impact", "lattice.imperfection": 0.3})
    found = same_design(others, design)
    assert list(found["case_id"]) == [designs["case_id"].iloc[k] for k in (2, 4)]
    assert same_design(others.assign(platen="contact"), design).empty
    assert same_design(others.assign(**{"lattice.wall_thickness": 1.0}), design).empty
