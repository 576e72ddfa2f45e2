"""Loading scenes: their labels, and that their cases are never compared."""

import re

import pytest

from sweep.ranking.rank import rank
from sweep.ranking.scenes import by_scene
from tests.support.results.specimens import designs, ids, summary

NAN = float("nan")
STRUCK = {"loading_mode": "impact", "striker_mass_g": 50.0, "striker_speed_m_per_s": 2.0}
LOADED = {"loading_mode": "force", "force_N": 10.0}


def test_scenes_are_never_compared():
    table = summary({}, {"platen": "contact"}, LOADED | {"force_N": 5.0}, LOADED)
    ranking = rank(table.assign(absorbed_energy_J=[0.5, 0.1, 0.2, 0.3]))
    assert list(ranking["place"]) == [1, 1, 1, 1]
    assert ranking["pareto"].all()
    assert list(ranking["scene"]) == [
        "crushed to 50 %, glued platens",
        "crushed to 50 %, contact platens",
        "dead load of 5 N, glued platens",
        "dead load of 10 N, glued platens",
    ]


@pytest.mark.parametrize("load", [LOADED, STRUCK])
def test_loads_on_periods_of_unequal_area_are_never_compared(load):
    """The load or the striker acts on each period, whatever its area."""
    table = summary({"outer_width_m": 0.01}, {"outer_width_m": 0.02}, {"sides": "free"}, load)
    table = table.assign(**load, depth_m=0.01, sides=["tied", "tied", "free", "free"])
    whole, *_ = by_scene(table[2:])
    assert list(by_scene(table)) == [
        *(whole.replace(", glued", f" on {area} mm2 of a panel, glued") for area in (100, 200)),
        whole,
    ]


def test_a_label_has_what_presses_and_what_carries():
    scenes = by_scene(summary({"striker": "nose"}, {"base": "ribs"}))
    assert list(scenes) == [
        "crushed to 50 %, striker nose, glued base",
        "crushed to 50 %, flat striker, on ribs",
    ]


def test_assumptions_make_scenes_and_designs_do_not():
    table = summary(*designs([1.0, 1.0, 1.0], [0.1, 0.2, 0.3]))
    other = {"contact.friction": [0.2, 0.9, 0.9], "lattice.infill": [0.1, 0.1, 0.3]}
    ranking = rank(table.assign(**other))
    assert ids(ranking) == [0, 2, 1]
    assert ranking["scene"].nunique() == 2
    assert ranking.loc[0, "scene"].endswith(", contact friction 0.2")


CLOSE = [
    (STRUCK, "striker_speed_m_per_s", 3.1, 3.1004),
    (STRUCK, "striker_mass_g", 1000.1, 1000.4),
    (STRUCK, "target_mass_g", 0.0, NAN),
    (LOADED, "force_N", 10.0, 10.00001),
    ({}, "lattice.imperfection", 0.01, 0.010004),
    ({}, "lattice.imperfection", 1e-6, 1.1e-6),
    ({}, "stroke_m", 6.1e-3, 6.1e-3 * (1.0 + 1e-8)),
    ({"base": "ribs"}, "platen", "contact", "glued"),
]


@pytest.mark.parametrize(("common", "key", "one", "other"), CLOSE)
def test_scenes_that_hardly_differ_have_labels_that_differ(common, key, one, other):
    table = summary(*(common | {key: value} for value in (one, other, one)))
    labels = rank(table)["scene"]
    assert (len(labels), labels.nunique()) == (3, 2)


def test_digits_of_a_label_grow_only_where_scenes_are_alike():
    rows = [STRUCK | {"striker_speed_m_per_s": speed} for speed in (3.1, 3.1004, 7.12345)]
    speeds = [re.search(r"50 g at (.*?) m/s", label)[1] for label in by_scene(summary(*rows))]
    assert speeds == ["3.1", "3.1004", "7.123"]


SAME = [
    ({"loading.strain": 0.5, "loading.stroke": NAN}, {"loading.stroke": 6.1e-3}),
    ({"loading.strain": 0.5}, {"loading.strain": 0.5 + 1e-15}),
    ({"loading.strain": 0.5}, {"loading.strain": NAN}),
    ({"stroke_m": 6.1e-3 * (1.0 + 1e-12)}, {}),
    ({"stroke_m": 5e-3, "height_m": 10e-3}, {}),
    ({"lattice.imperfection": 0.1 + 0.2}, {"lattice.imperfection": 0.3}),
]


@pytest.mark.parametrize("rows", SAME)
def test_scenes_that_differ_by_round_off_or_in_words_are_one(rows):
    (scene,) = by_scene(
        summary(*({"loading.strain": NAN, "loading.stroke": NAN} | r for r in rows))
    )
    assert scene.startswith("crushed to 50 %, glued platens")


def test_label_leaves_out_keys_that_a_scene_does_without():
    keys = "loading.strain", "solver.integrator", "solver.time_step"
    values = (0.5, "", NAN), (NAN, "bdf2", NAN), (NAN, "bdf2", 0.001)
    crush, *loads = (dict(zip(keys, row, strict=True)) for row in values)
    table = summary(crush, *(LOADED | {"force_N": 5.0} | row for row in loads))
    assert list(rank(table)["scene"]) == [
        "crushed to 50 %, glued platens",
        "dead load of 5 N, glued platens, solver integrator bdf2",
        "dead load of 5 N, glued platens, solver integrator bdf2, solver time step 1 ms",
    ]
