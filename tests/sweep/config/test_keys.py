"""The keys of a config: what each accepts, in words; other names; the nearest to a misspelt one."""

import pytest

from sweep.config.keys import case_keys, nearest, table_keys
from sweep.design.infill import families
from sweep.design.surfaces.names import SHEETS

KINDS = [f'"{word}"' for word in (*families(), *SHEETS, "custom", "drawn")]


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ('[lattice]\nkind = "heptagon"', ['"hex" ("honeycomb"), ', '"kagome" ("stars"), ', *KINDS]),
        ('[solver]\nintegrator = "bdf3"', ['"bdf2", "newmark", "static" or "arc_length"']),
        ('[loading]\nmode = "impact"\nfilter_class = "60"', ["60, 180, 600 or 1000"]),
    ],
)
def test_unknown_choices_name_the_known_ones(last_refused, text, known):
    assert last_refused(text, "unknown choice; allowed: ", *known)


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
    rank = {f"rank.{name}" for name in ("budgets", "panel", "drop_heights", "per")}
    assert set(table_keys("rank")) == rank
    assert "lattice.structure" not in case_keys()
