"""Drop tests of standards: their heights, and the limits of a flat planar model."""

import pytest

from sweep.config.case import Case
from sweep.config.drop_tests import drop_of, drops, in_si, limits

ALLOWED = "allowed: ista-1a, ista-2a or mil-std-810 with a mass or a height"


@pytest.mark.parametrize(
    ("preset", "words"),
    [
        ("ista-9", ["unknown test"]),
        ("ista-1a", ["neither a mass nor a height"]),
        ("ista-1a 68 kg", ["ends at 68 kg"]),
        ("ista-1a 0 kg", ["ends at 68 kg"]),
        ("mil-std-810 1 m", ["no height of mil-std-810", "1.22 m"]),
        ("mil-std-810 1 s", ['"s" is a unit of another kind']),
        ("en-1078 5 kg", ["cannot claim en-1078", "J/cm2"]),
        ("en-1621-1", ["cannot claim en-1621-1", "J/cm2"]),
    ],
)
def test_what_is_no_drop_is_one_line(last_refused, preset, words):
    assert last_refused(f'[loading]\npreset = "{preset}"', *words, ALLOWED)


def test_height_goes_by_the_mass():
    masses = (0.1, 9.99, 10.0, 18.9, 19.0, 28.0, 45.0, 67.9)
    heights = [drop_of(f"ista-1a {mass} kg").height for mass in masses]
    assert heights == [0.76, 0.76, 0.61, 0.61, 0.46, 0.31, 0.20, 0.20]
    assert drop_of("ista-2a 5 kg") == (5.0, 0.97)
    assert drop_of("mil-std-810 1.22 m") == (None, 1.22)


def test_heavier_packages_fall_less_far():
    flat = [limits(name) for name, rows in drops().items() if rows]
    assert len(flat) == 3
    for rows in flat:
        masses, heights = zip(*rows, strict=True)
        assert [*masses] == sorted({*masses})
        assert [*heights] == sorted({*heights}, reverse=True)


def test_units_are_those_of_a_case():
    assert in_si("ista-1a 5000 g") == "ista-1a 5 kg"
    assert in_si("mil-std-810 122 cm") == "mil-std-810 1.22 m"


def test_a_preset_is_a_mass_and_a_height(load):
    text = '[loading]\nspecimens = 20\n[grid]\n"loading.preset" = ["ista-1a 5 kg"]'
    (case,) = load(text).cases
    by_hand = Case.of(loading=dict(striker_mass=0.25, drop_height=0.76))
    assert case.case_id == by_hand.case_id
    assert case.axes == {"loading.preset": "ista-1a 5 kg"}
    assert Case.of(loading=case.loading).loading == case.loading


PRESET = 'preset = "ista-1a 5 kg"\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (PRESET + 'striker_mass = "1 lb"', "11.02 lb"),
        (PRESET + 'drop_height = "1 m"', "0.76 m"),
        ('striker_mass = "1 g"\nspecimens = 3', "loading.preset has a mass"),
    ],
)
def test_contradictions_are_one_line(last_refused, text, words):
    assert last_refused(f"[loading]\n{text}", words)


def test_a_mass_that_a_preset_lacks_is_needed(refused):
    text = '[loading]\npreset = "mil-std-810 1.22 m"'
    assert refused(text, "loading.striker_mass", "as the preset has none")


def test_a_preset_that_is_none_is_refused_in_python_too():
    with pytest.raises(ValueError, match="unknown test"):
        Case.of(loading=dict(preset="ista-9 5 kg"))
