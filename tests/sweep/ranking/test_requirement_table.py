"""The list of requirements: a row each, which config, options, sentences and page follow."""

import pytest

from sweep.cli.parser import parser
from sweep.config.keys import table_keys
from sweep.config.units import quantity
from sweep.loading_modes import applies_to
from sweep.ranking.requirement_table import MEASURES
from sweep.report.tables.requirement_notes import quantity as text_of


def test_the_keys_of_a_config_are_those_of_the_list():
    keys = {name.removeprefix("require."): key.unit for name, key in table_keys("require").items()}
    assert list(keys) == list(MEASURES)
    assert keys == {name: measure.unit for name, measure in MEASURES.items()}


@pytest.mark.parametrize("name", MEASURES)
def test_a_requirement_is_an_option_of_every_question(name):
    option = f"--{name.replace('_', '-')}"
    for words in (["rank", "a.h5"], ["show", "a.h5"], ["optimize", "a.toml"]):
        arguments = parser().parse_args([*words, option, MEASURES[name].example])
        assert getattr(arguments, name) == MEASURES[name].example


@pytest.mark.parametrize(("name", "measure"), MEASURES.items())
def test_an_example_is_shown_in_the_unit_of_a_maker(name, measure):
    value = quantity(measure.example, measure.unit)
    assert text_of(name, value).endswith(f" {measure.shown}")
    assert quantity(text_of(name, value), measure.unit) == pytest.approx(value)
    assert applies_to(name)
