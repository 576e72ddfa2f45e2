"""Rankings with few columns equal rankings with all, and no column that decides places is
missing.
"""

import ast
from pathlib import Path

import pandas as pd
import pytest

import sweep
from sweep.columns import COLUMNS
from sweep.ranking.needed_columns import NEEDED, needed_columns, widened
from sweep.ranking.question import RankError
from tests.support.results.specimens import summary

FOLDER = Path(sweep.__file__).parent
BESIDE = ("accuracy.py", "cushion.py", "needed_columns.py", "rank.py", "spread.py")
"""Modules of rankings that read other tables, or name all columns by which one may sort."""


def test_every_column_that_rankings_name_is_needed():
    files = [f for f in (FOLDER / "ranking").glob("*.py") if f.name not in BESIDE]
    files += [FOLDER / "loading_modes.py", FOLDER / "design" / "panel.py"]
    trees = [ast.parse(file.read_text("utf-8")) for file in files]
    texts = {n.value for tree in trees for n in ast.walk(tree) if isinstance(n, ast.Constant)}
    assert texts & COLUMNS.keys() <= NEEDED <= COLUMNS.keys()


def test_errors_ranges_and_energies_up_to_forces_belong_to_what_is_needed():
    kept = ["error_mass_g", "correction_peak_force_N", "lowest_densification_strain"]
    kept += ["absorbed_energy_at_20N_J", "error_absorbed_energy_at_20N_J", "solver.time_step"]
    left = ["error_steps", "lattice.depth"]
    table = summary(dict.fromkeys([*kept, *left], 1.0))
    names = {*needed_columns(table)}
    assert names >= {*kept}
    assert not names & {*left, "steps"}
    assert {*needed_columns(table, ["steps"])} - names == {"steps", "error_steps"}


def test_rows_get_back_the_columns_that_they_had_before_those_that_were_added():
    table = summary({}, {"mass_g": 2.0}, {"mass_g": 3.0})
    rows = needed_columns(table).assign(place=[3, 2, 1]).sort_values("place")
    whole = widened(rows, table, ["place", "mass_g", "unknown"])
    others = [name for name in table if name != "mass_g"]
    assert list(whole) == ["place", "mass_g", *others]
    pd.testing.assert_frame_equal(whole[[*table]], table[::-1])
    twice = widened(pd.concat([rows, rows]), table)
    pd.testing.assert_frame_equal(twice[[*table]], pd.concat([table[::-1]] * 2))


def test_a_column_that_is_missing_is_named():
    with pytest.raises(RankError, match=r"no height_m; needed: all columns of a summary"):
        needed_columns(summary({}).drop(columns="height_m"))
