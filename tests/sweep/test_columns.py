"""The columns of results: their units and meaning, fixed or derived from a name."""

import re
from typing import get_args

import pytest

from sweep.columns import (
    COLUMNS,
    HISTORY_COLUMNS,
    RANKING_COLUMNS,
    STRIKER_COLUMNS,
    UNIT,
    absorbed_energy_column,
    cycle_columns,
    describe_column,
    in_words,
    is_column,
    is_grid_key,
)
from sweep.config.keys import CHOICES


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("peak_force_N", "peak force, in N"),
        ("mass_g", "mass, in g"),
        ("peak_strain", "peak strain"),
        ("lost_energy_J_per_g", "lost energy, in J/g"),
        ("absorbed_energy_at_50N_J", "absorbed energy up to 50 N, in J"),
        ("absorbed_energy_until_packed_J", "absorbed energy until densification, in J"),
        ("peak_deceleration_filtered_m_per_s2", "peak deceleration filtered, in m/s^2"),
        ("energy_to_50_J_per_m3", "energy to 50, in J/m^3"),
    ],
)
def test_columns_in_words_have_their_unit(name, words):
    assert in_words(name) == words


@pytest.mark.parametrize("columns", [COLUMNS, HISTORY_COLUMNS, STRIKER_COLUMNS, RANKING_COLUMNS])
def test_every_column_has_units_that_its_name_ends_in(columns):
    """J_per_m3 is J/m^3; `UNIT` has all of these endings."""
    for name, column in columns.items():
        found = UNIT.search(name)
        said = re.sub(r"(\d)$", r"^\1", found[1].replace("_per_", "/")) if found else '"" or "1"'
        assert column.description, f"{name} has no sentence"
        assert column.units == said if found else column.units in ("", "1"), (
            f"{name} has units {column.units!r}, and by its name {said}: "
            "a unit that is new to columns needs its ending in UNIT"
        )


def test_text_is_neither_better_nor_worse():
    words = [name for name, column in COLUMNS.items() if not column.units]
    assert {"case_id", "material"} < set(words)
    assert {COLUMNS[name].better for name in words} == {None}


def test_grid_key_has_the_unit_of_its_parameter():
    assert describe_column("lattice.wall_thickness").units == "m"
    assert describe_column("damping.mass").units == "1/s"
    assert describe_column("lattice.cells").units == ""


@pytest.mark.parametrize(
    ("column", "key"),
    [
        ("platen", "loading.platen"),
        ("contact_model", "contact.model"),
    ],
)
def test_choices_are_those_that_a_config_has(column, key):
    choices = [word for word in get_args(CHOICES[key]) if word != "auto"]  # not kept
    said = COLUMNS[column].description.split(": ")[-1]
    assert said == f"{', '.join(choices[:-1])} or {choices[-1]}"


@pytest.mark.parametrize(
    ("name", "units", "better", "told"),
    [
        (absorbed_energy_column(50.0), "J", "more", "50 N"),
        (absorbed_energy_column(12.5), "J", "more", "12.5 N"),
        ("specific_absorption_at_densification_J_per_g", "J/g", "more", ""),
        ("specific_absorption_J_per_g", "J/g", "more", ""),
        (cycle_columns(2)[0], "J", "more", "cycle 2"),
        (cycle_columns(2)[1], "J", "more", "cycle 2"),
        (cycle_columns(12)[2], "N", "less", "cycle 12"),
        ("error_absorbed_energy_J", "J", "less", "no bound"),
        (f"error_{absorbed_energy_column(50.0)}", "J", "less", "no bound"),
        (absorbed_energy_column(1.5), "J", "more", "1.5"),
        ("correction_peak_strain", "1", None, ""),
    ],
)
def test_columns_that_follow_from_a_name_have_units_and_say_what_is_better(
    name, units, better, told
):
    column = describe_column(name)
    assert (column.units, column.better) == (units, better)
    assert told in column.description
    assert is_column(name)
    assert not is_grid_key(name)


def test_all_keys_of_a_grid_are_known_by_their_form():
    assert all(is_grid_key(key) and not is_column(key) for key in CHOICES)
