"""The keys of a config: what each accepts, in words; other names; the nearest to a misspelt one."""

import pytest

from sweep.config.grid import expand
from sweep.config.keys import QUANTITIES, case_keys, nearest, table_keys
from sweep.design.infill import families
from sweep.design.surfaces.names import SHEETS


def test_every_unit_of_the_keys_is_described():
    units = {key.unit for key in case_keys().values() if key.unit}
    assert units <= set(QUANTITIES)


def test_load_steps_has_two_names(load):
    (case,) = expand(load('[loading]\nmode = "displacement"\nload_steps = 50'))
    assert case.solver.load_steps == 50


CHOICES = {
    '[loading]\nmode = "shake"': (
        *('loading.mode = "shake"', '"force" ("dead load"), ', '"displacement" ("crush"), '),
        *('"impact", ', '"drop"', '"custom"'),
    ),
    '[lattice]\nkind = "heptagon"': (
        *('lattice.kind = "heptagon"', '"hex" ("honeycomb"), ', '"kagome" ("stars"), '),
        *(f'"{word}"' for word in (*families(), *SHEETS, "custom", "drawn")),
    ),
    '[solver]\nintegrator = "bdf3"': (
        *('solver.integrator = "bdf3"', '"bdf2", "newmark", "static" or "arc_length"'),
    ),
}


@pytest.mark.parametrize("text", CHOICES)
def test_unknown_choices_name_the_known_ones(refused, text):
    assert refused(text, *CHOICES[text], "unknown choice; allowed: ")


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("lattice.wall", "lattice.wall_thickness"),
        ("cells", "lattice.cells"),
        ("solver.tolerence", "solver.tolerance"),
    ],
)
def test_the_nearest_key_begins_so_or_looks_most_like_it(name, wanted):
    assert nearest(name, case_keys()) == wanted


def test_keys_tell_their_unit_and_what_they_set():
    wall, cells = case_keys()["lattice.wall_thickness"], case_keys()["lattice.cells"]
    assert (wall.unit, wall.bare, wall.is_list) == ("m", False, False)
    assert cells.targets == ("lattice.cells_x", "lattice.cells_y")
    assert set(table_keys("rank")) == {
        "rank.budgets",
        "rank.panel",
        "rank.drop_heights",
        "rank.per",
    }
    assert "lattice.structure" not in case_keys()
