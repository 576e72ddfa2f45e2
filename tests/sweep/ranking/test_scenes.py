"""Loading scenes: their labels, and that their cases are never compared."""

from sweep.ranking.rank import rank
from sweep.ranking.scenes import scene_label
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


def test_scenes_never_share_a_label():
    rows = [{"loading.strain": strain, "stroke_m": strain * 12.2e-3} for strain in (0.6, 0.604)]
    rows += [row | {"height_m": 10e-3} for row in rows]
    rows += [{"loading.strain": float("nan"), "contact.friction": mu} for mu in (0.2, 0.3)]
    assert rank(summary(*rows))["scene"].nunique() == 4


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


def test_label_leaves_out_a_depth_that_differs():
    table = summary({"stroke_m": 3.05e-3}, {})
    assert scene_label(table) == "crushed, glued platens"
