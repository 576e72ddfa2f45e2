"""Words of slicers and users: each means a choice or a key that there is."""

from contextlib import nullcontext

import pytest

from sweep.config.grid import expand
from sweep.config.keys import case_keys, table_keys
from sweep.config.reading.other_names import CHOICES, KEYS, meant, present_choice
from sweep.design.slicer.patterns import SLICERS


@pytest.mark.parametrize("key", CHOICES)
def test_words_mean_choices_that_there_are_and_are_none_themselves(key):
    adapter = case_keys()[key].adapter
    assert all(adapter.validate_python(choice) == choice for choice in CHOICES[key].values())
    open_key = key == "lattice.pattern"  # each slicer has patterns of its own
    assert not open_key or {*CHOICES[key].values()} <= SLICERS["orca"].keys()
    for word in CHOICES[key]:
        with nullcontext() if open_key else pytest.raises(ValueError, match=r"literal_error|Input"):
            adapter.validate_python(word)
        assert word not in CHOICES[key].values()


def test_hints_name_keys_that_there_are_and_are_none_themselves():
    known = case_keys() | table_keys("rank")
    assert {key for key, _ in KEYS.values()} <= known.keys()
    assert not {f"{key.split('.')[0]}.{word}" for word, (key, _) in KEYS.items()} & known.keys()


def test_words_are_understood_in_every_table(load):
    text = (
        '[lattice]\nwidth = "25 mm"\nheight = "25 mm"\n[grid]\n'
        'lattice.kind = ["grid", "Hex", "auxetic"]\nloading.mode = ["Crush", "drop"]\n'
        '[[exclude]]\nlattice.kind = "re-entrant"'
    )
    kinds = [(case.lattice.kind, case.loading.mode) for case in expand(load(text))]
    modes = ["displacement", "impact"]
    assert kinds == [(kind, mode) for kind in ("square", "hex") for mode in modes]


def test_a_drop_is_an_impact_that_can_be_excluded(load):
    text = '[grid]\nloading.mode = ["impact", "drop"]\n[[exclude]]\nloading.mode = "drop"'
    (case,) = expand(load(text))
    assert (case.loading.mode, case.loading.gravity) == ("impact", False)


ORCA = 'slicer = "orca"\ninfill = "20 %"\n'


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            '[loading]\nmode = "crash"',
            ['"force" ("dead load"), ', '; the nearest is "crush"'],
        ),
        (
            '[lattice]\nkind = "gird"',
            ['allowed: "brick"', '; the nearest is "grid"'],
        ),
        ('[lattice]\nkind = "gyriod"', ['; the nearest is "gyroid"']),
        (f'[lattice]\n{ORCA}pattern = "tmpsd"', ['; the nearest is "tpmsd"']),
        ('[loading]\nfall_height = "0.5 m"', ["unknown key; the nearest is loading.drop_height"]),
        (
            '[lattice]\ninfill_pattern = "hex"',
            ["lattice.pattern: with lattice.slicer"],
        ),
        (
            '[material]\nfile = "own.csv"',
            ["material.name: of one that is"],
        ),
    ],
)
def test_what_a_user_may_think_of_is_answered_with_what_there_is(last_refused, text, told):
    assert last_refused(text, *told)


def test_other_values_are_left_for_the_key_to_refuse():
    assert present_choice("lattice.kind", 3) == 3
    assert present_choice("material.name", "grid") == "grid"


def test_hint_that_does_not_belong_to_the_known_keys_is_not_given():
    assert meant("budget", ["name", "rank"]) == ("name", "the nearest is name")
