"""The table of modes: complete, and its words of columns and requirements are the ones in use."""

from math import isnan

import pytest
from pandas import DataFrame

from sweep.columns import COLUMNS, HISTORY_COLUMNS
from sweep.config.case import Case
from sweep.config.kinds.loading import KINDS as LOADINGS
from sweep.loading_modes import MODES, applies_to, compared, has, is_coarse, mode_of
from sweep.numbers import FACTORS
from sweep.ranking.requirement_table import MEASURES
from sweep.result import LOADED

KINDS = {kind.words[0]: kind for kind in LOADINGS}
ROWS = DataFrame({"loading_mode": ["displacement", "impact", "force", "custom"]})


def test_every_kind_of_loading_has_its_mode():
    assert set(KINDS) == set(MODES)


@pytest.mark.parametrize("name", MODES)
def test_a_mode_names_columns_and_requirements_that_are_there(name):
    mode = MODES[name]
    assert {*mode.requires} <= {*MEASURES}
    assert {*mode.columns, *mode.scene} <= {*COLUMNS}
    assert {axis.column for axis in mode.curve} <= {*HISTORY_COLUMNS}
    assert {axis.unit for axis in mode.curve} <= {*FACTORS}


@pytest.mark.parametrize("name", [name for name, mode in MODES.items() if mode.least])
def test_what_is_compared_is_a_column_of_which_less_is_better(name):
    least = MODES[name].least
    assert COLUMNS[least.column].better == "less"
    assert least.unit in FACTORS
    assert least.merit.format("7").count("7") == 1
    assert not MODES[name].driven


def test_columns_of_a_loading_are_those_of_its_kind():
    for name in {*MODES} - {"custom"}:
        assert {*MODES[name].scene} <= {*MODES[name].columns}
        assert {*Case.of(loading={"mode": name}).loading.columns} == {*MODES[name].columns}
    assert {*KINDS["custom"].columns} == {*MODES["custom"].columns}
    assert {column for mode in MODES.values() for column in mode.columns} == {*LOADED}


def test_each_trait_row_by_row():
    expected = {"driven": 0, "struck": 1, "dead": 2, "probed": 3}
    for trait, row in expected.items():
        assert list(has(ROWS, trait)) == [k == row for k in range(4)]
    assert has(ROWS[:0], "driven").dtype == bool


@pytest.mark.parametrize("much", [False, True])
def test_steps_are_long_by_the_measure_of_the_mode(much):
    measures = [each for mode in MODES.values() for each in mode.coarse]
    shares = {each.column: 0.0 for each in measures if not isnan(each.most)}
    peaks = {each.column: 1.0 for each in measures if isnan(each.most)}
    for name, coarse in ((name, each) for name, mode in MODES.items() for each in mode.coarse):
        rows, own = ROWS.assign(**shares, **peaks), ROWS["loading_mode"] == name
        if isnan(coarse.most):
            rows.loc[own & much, coarse.column] = float("nan")
        else:
            rows.loc[own, coarse.column] = coarse.most * (1.01 if much else 0.99)
        assert list(is_coarse(rows)) == list(own & much)
    unknown = ROWS.assign(**dict.fromkeys(shares, float("nan")), **peaks)
    assert not is_coarse(unknown).any()


def test_the_mode_of_a_scene_is_the_one_of_its_rows():
    assert mode_of(ROWS[1:2]) is MODES["impact"]
    columns = [compared(ROWS[k : k + 1]) for k in range(4)]
    assert columns == [None, "peak_force_N", "peak_strain", None]


def test_modes_of_a_requirement():
    assert applies_to("min_absorbed") == ("displacement",)
    assert applies_to("max_stroke")[:3] == ("displacement", "impact", "force")
    assert applies_to("max_mass") == tuple(MODES)
