"""Reactions of a user's own structure: reactions are drawn over the load."""

import numpy as np
import pandas as pd
import pytest

from sweep.report.figures.case_plots import blank
from sweep.report.figures.probe_plots import COLORS, probe_reactions
from tests.support.results.specimens import summary

TIME = np.linspace(0.0, 0.02, 3)


@pytest.fixture
def drawn():
    """The picture of a history, of three rows, with these columns."""
    (row,) = summary({"loading_mode": "custom"}).to_dict("records")

    def draw(**columns):
        ax = blank(5, 3).subplots()
        history = {"time_s": TIME, "reaction_bottom_N": np.full(3, np.nan)} | columns
        probe_reactions(ax, pd.DataFrame(history), row)
        return ax

    return draw


def curves(ax):
    """The drawn curves, by their names in the legend."""
    handles, labels = ax.get_legend_handles_labels()
    return dict(zip(labels, (line.get_xydata() for line in handles), strict=True))


def test_forces_are_drawn_over_time_and_what_bears_nothing_is_not(drawn):
    ax = drawn(
        probe_3_reaction_x_N=[0.0, 0.0, 0.0], probe_3_reaction_y_N=[0.0, 1.0, -2.0],
        probe_12_reaction_moment_Nm=[0.0, 1.0, 2.0], probe_12_y_m=[0.0, 1.0, 2.0],
    )  # fmt: skip
    assert list(curves(ax)) == ["y at node 3"]
    expected = np.column_stack([1e3 * TIME, [0.0, 1.0, -2.0]])
    np.testing.assert_allclose(curves(ax)["y at node 3"], expected)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time, ms", "reaction, N")


def test_without_time_they_are_drawn_over_the_load_factor(drawn):
    factor = [0.0, 0.5, 1.0]
    ax = drawn(load_factor=factor, reaction_bottom_N=[0.0, 3.0, 4.0])
    np.testing.assert_allclose(curves(ax)["floor"], np.column_stack([factor, [0.0, 3.0, 4.0]]))
    assert ax.get_xlabel() == "load factor"


def test_more_curves_than_colours_are_told_apart_by_their_dashes(drawn):
    ax = drawn(**{f"probe_{k}_reaction_x_N": TIME for k in range(len(COLORS) + 1)})
    looks = [(line.get_color(), line.get_linestyle()) for line in ax.get_lines()[:-1]]
    assert len(set(looks)) == len(looks) == len(COLORS) + 1


def test_nothing_borne_has_no_legend(drawn):
    assert drawn(probe_0_reaction_x_N=np.zeros(3)).get_legend() is None
