"""Reactions of a user's own structure: reactions are drawn over the load."""

import numpy as np
import pandas as pd

from sweep.report.figures.case_plots import blank
from sweep.report.figures.probe_plots import COLORS, probe_reactions
from tests.support.results.specimens import summary

TIME = np.linspace(0.0, 0.02, 3)


def drawn(**columns):
    (row,) = summary({"loading_mode": "custom"}).to_dict("records")
    ax = blank(5, 3).subplots()
    history = {"time_s": TIME, "reaction_bottom_N": np.full(3, np.nan)} | columns
    probe_reactions(ax, pd.DataFrame(history), row)
    return ax


def test_forces_are_drawn_over_time_and_what_bears_nothing_is_not():
    ax = drawn(
        probe_3_reaction_x_N=[0.0, 0.0, 0.0], probe_3_reaction_y_N=[0.0, 1.0, -2.0],
        probe_12_reaction_moment_Nm=[0.0, 1.0, 2.0], probe_12_y_m=[0.0, 1.0, 2.0],
    )  # fmt: skip
    (curve,), names = ax.get_legend_handles_labels()
    assert names == ["y at node 3"]
    np.testing.assert_allclose(curve.get_xydata().T, [1e3 * TIME, [0.0, 1.0, -2.0]])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time, ms", "reaction, N")
    assert drawn(probe_0_reaction_x_N=np.zeros(3)).get_legend() is None


def test_without_time_they_are_drawn_over_the_load_factor():
    factor = [0.0, 0.5, 1.0]
    ax = drawn(load_factor=factor, reaction_bottom_N=[0.0, 3.0, 4.0])
    (curve,), names = ax.get_legend_handles_labels()
    assert (names, ax.get_xlabel()) == (["floor"], "load factor")
    np.testing.assert_allclose(curve.get_xydata().T, [factor, [0.0, 3.0, 4.0]])


def test_more_curves_than_colours_are_told_apart_by_their_dashes():
    ax = drawn(**{f"probe_{k}_reaction_x_N": TIME for k in range(len(COLORS) + 1)})
    looks = [(line.get_color(), line.get_linestyle()) for line in ax.get_lines()[:-1]]
    assert len(set(looks)) == len(looks) == len(COLORS) + 1
