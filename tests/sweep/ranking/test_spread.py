"""Spreads of rankings: values at the corners, places, and whether the order changes."""

import numpy as np
import pytest

from sweep.ranking.question import Question
from sweep.ranking.rank import ranked
from sweep.ranking.spread import AS_GIVEN, ends, spread_table, spreads
from tests.support.results.specimens import designs, summary

NAMES = ("soft", "hard")


def found(at_corners, masses=(1.0, 1.0), heavier=None, **question):
    """The spread of designs of 0.4 and 0.3 J; at_corners: energies (J) at two corners of each
    design; heavier: its mass (g) there, if it is another.
    """
    own = summary(*designs(masses, [0.4, 0.3]))
    flat = [energy for several in at_corners for energy in several]
    rows = summary(*designs([mass for mass in heavier or masses for _ in NAMES], flat))
    rows["case_id"] = [f"corner {k}" for k in range(len(flat))]
    rows["loaded"] = rows["absorbed_energy_J"].notna().astype(int)
    corners = {
        case_id: [(name, f"corner {2 * k + j}") for j, name in enumerate(NAMES)]
        for k, case_id in enumerate(own["case_id"])
    }
    return spreads(ranked(own, **question), rows, corners, Question(**question))


def test_values_and_places_at_the_corners():
    (spread,) = found([(0.2, 0.8), (0.25, 0.5)])
    assert spread.rows["place"].tolist() == [1, 2]
    assert spread.at_corners["soft"].tolist() == pytest.approx([0.2, 0.25])
    assert spread.at_corners[AS_GIVEN].tolist() == pytest.approx([0.4, 0.3])
    assert spread.places.to_numpy().tolist() == [[1.0, 2.0, 1.0], [2.0, 1.0, 2.0]]
    assert (spread.swaps, spread.failed) == (["soft"], 0)
    assert spread.worst.tolist() == pytest.approx([0.2, 0.25])
    assert [spread.first(name) for name in NAMES] == [1, 0]


def test_failed_corners_are_counted_and_left_out():
    (spread,) = found([(np.nan, 0.8), (0.25, 0.5)])
    assert (spread.failed, spread.swaps) == (1, [])
    assert spread.worst.tolist() == pytest.approx([np.nan, 0.25], nan_ok=True)
    assert ends(spread.at_corners.iloc[0]) == (AS_GIVEN, "hard")


def test_no_swaps_where_the_order_stays_or_less_is_better():
    (spread,) = found([(0.2, 0.8), (0.15, 0.8)])
    assert spread.swaps == []
    (spread,) = found([(0.2, 0.8), (0.25, 0.5)], by="mass_g", masses=(1.0, 2.0))
    assert (spread.places[AS_GIVEN].tolist(), spread.swaps) == ([1.0, 2.0], [])


def test_each_budget_has_its_own():
    several = found([(0.2, 0.8), (0.25, 0.5)], masses=(1.0, 2.0), budget=[1e-3, 5e-3])
    assert [len(spread.rows) for spread in several] == [1, 2]


def test_limits_that_corners_miss_are_told():
    asked = {"budget": [1.15e-3], "require": {"min_absorbed": "0.3 J"}}
    corners = [(0.5, 0.6), (0.25, 0.5)]
    (spread,) = found(corners, masses=(1.0, 1.1), heavier=(1.0, 1.2), **asked)
    assert spread.masses.to_numpy().tolist() == [[1.0, 1.0, 1.0], [1.1, 1.2, 1.2]]
    soft = [(2, "soft", "budget"), (2, "soft", "min_absorbed")]
    assert list(spread.missed) == [*soft, (2, "hard", "budget")]


def test_the_table_has_the_ends_of_each_design():
    table = spread_table(found([(0.2, 0.8), (np.nan, 0.5)]))
    first, second = table.to_dict("records")
    told = ("value", "lowest", "lowest_at", "highest", "highest_at")
    assert [first[name] for name in told] == [0.4, 0.2, "soft", 0.8, "hard"]
    assert (first["best_place"], first["worst_place"]) == (1, 1)
    assert (second["lowest_at"], second["failed"], first["failed"]) == (AS_GIVEN, 1, 0)
    assert spread_table(found([(0.2, 0.8), (0.25, 0.5)]))["changes_order"].tolist() == ["soft"] * 2
    assert spread_table([]).empty
