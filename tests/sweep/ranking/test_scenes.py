"""Loading scenes: their labels, and that their cases are never compared."""

import numpy as np
import pytest

from sweep.ranking.rank import rank, ranked
from sweep.ranking.scenes import by_scene, scene_labels
from tests.support.results.specimens import designs, ids, summary

NAN = float("nan")


def test_scenes_are_never_compared():
    table = summary(
        {"absorbed_energy_J": 0.5},
        {"absorbed_energy_J": 0.1, "platen": "contact"},
        {"absorbed_energy_J": 0.2, "loading_mode": "force", "force_N": 5.0, "stroke_m": NAN},
        {"absorbed_energy_J": 0.3, "loading_mode": "force", "force_N": 10.0, "stroke_m": NAN},
    )
    ranking = rank(table)
    assert list(ranking["place"]) == [1, 1, 1, 1]
    assert ranking["pareto"].all()
    assert list(ranking["scene"]) == [
        "crushed to 50 %, glued platens",
        "crushed to 50 %, contact platens",
        "dead load of 5 N, glued platens",
        "dead load of 10 N, glued platens",
    ]


def test_assumptions_make_scenes_and_designs_do_not():
    rows = designs([1.0, 1.0, 1.0], [0.1, 0.2, 0.3])
    for row, friction, infill in zip(rows, [0.2, 0.9, 0.9], [0.1, 0.1, 0.3], strict=True):
        row |= {"contact.friction": friction, "lattice.infill": infill}
    ranking = rank(summary(*rows))
    assert ids(ranking) == [0, 2, 1]
    assert ranking["scene"].nunique() == 2
    assert ranking.loc[0, "scene"].endswith(", contact friction 0.2")


STRUCK = {"loading_mode": "impact", "striker_mass_g": 50.0, "striker_speed_m_per_s": 2.0}
LOADED = {"loading_mode": "force", "force_N": 10.0}
CLOSE = [
    (STRUCK, "striker_speed_m_per_s", 3.1, 3.1004),
    (STRUCK, "striker_mass_g", 1000.1, 1000.4),
    (STRUCK, "target_mass_g", 0.0, NAN),
    (LOADED, "force_N", 10.0, 10.00001),
    ({}, "lattice.imperfection", 0.01, 0.010004),
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
    assert [label.partition(" m/s")[0] for label in by_scene(summary(*rows))] == [
        "struck by 50 g at 3.1",
        "struck by 50 g at 3.1004",
        "struck by 50 g at 7.123",
    ]


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


def close_scenes(rng):
    """A small summary whose scenes are often the same, or nearly."""
    near = np.array([0.0, 1e-15, 1e-12, 1e-8, 1e-5, 1e-3, 0.1])

    def about(value):
        return value * (1.0 + rng.choice(near))

    rows = []
    for _ in range(rng.integers(1, 12)):
        crush = {"stroke_m": about(6.1e-3), "loading.strain": rng.choice([0.5, NAN])}
        modes = [
            crush | {"loading.stroke": NAN if crush["loading.strain"] > 0.0 else crush["stroke_m"]},
            STRUCK | {"striker_speed_m_per_s": about(3.1), "target_mass_g": rng.choice([0.0, NAN])},
            LOADED | {"force_N": about(10.0)},
        ]
        row = {"contact.friction": NAN, "loading.strain": NAN, "loading.stroke": NAN}
        row |= modes[rng.integers(3)] | {"status": rng.choice(["converged"] * 3 + ["stopped"])}
        row |= {"platen": str(rng.choice(["glued", "contact"]))}
        row |= {"base": str(rng.choice(["flat", "ribs"])), "mass_g": rng.uniform(1.0, 2.0)}
        rows.append(row | ({"contact.friction": about(0.2)} if rng.random() < 0.3 else {}))
    table = summary(*rows)
    table.loc[rng.random(len(table)) < 0.1, "absorbed_energy_until_packed_J"] = NAN
    return table


@pytest.mark.parametrize("seed", range(60))
def test_every_case_is_ranked_or_counted_once(seed):
    table = close_scenes(np.random.default_rng([57, seed]))
    ranking, labels = ranked(table, top=None), scene_labels(table)
    assert len(ranking.table) + ranking.unranked + ranking.failed == ranking.cases == len(table)
    finished = table["loaded"] == 1
    assert list(ranking.lightest_g) == list(dict.fromkeys(labels[finished]))
    assert sum(ranking.lost.values()) == (~labels.isin(labels[finished])).sum()
    own = dict(zip(table["case_id"], labels, strict=True))
    assert list(ranking.table["scene"]) == [own[k] for k in ranking.table["case_id"]]
    exact = [*STRUCK, "force_N", "target_mass_g", "platen", "base", "contact.friction"]
    pressed = (table["stroke_m"] / table["height_m"]).where(table["loading_mode"] == "displacement")
    for _, rows in table.fillna(-1.0).assign(pressed=pressed).groupby(labels):
        for key in [*exact, "pressed"]:
            first, others = rows[key].iloc[0], rows[key]
            same = (
                others == first
                if key in {"platen", "base", "loading_mode"}
                else np.isclose(others.astype(float), first, rtol=2e-9, atol=0.0, equal_nan=True)
            )
            assert same.all(), key


def test_label_leaves_out_keys_that_a_scene_does_without():
    keys = "loading.strain", "solver.integrator", "solver.time_step"
    load = {"loading_mode": "force", "force_N": 5.0, "stroke_m": NAN}
    rows = [
        dict(zip(keys, (0.5, "", NAN), strict=True)),
        load | dict(zip(keys, (NAN, "bdf2", NAN), strict=True)),
        load | dict(zip(keys, (NAN, "bdf2", 0.001), strict=True)),
    ]
    assert list(rank(summary(*rows))["scene"]) == [
        "crushed to 50 %, glued platens",
        "dead load of 5 N, glued platens, solver integrator bdf2",
        "dead load of 5 N, glued platens, solver integrator bdf2, solver time step 1 ms",
    ]
