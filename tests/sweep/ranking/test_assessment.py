"""Values of designs in a search, and the front of two aims."""

import pytest

from sweep.ranking.assessment import assess, check_column, check_searched, front, thinned
from sweep.ranking.question import Question, RankError
from tests.support.results.specimens import designs, summary


def table(**changes):
    """Designs of 1, 2, 3 and 4 g; `changes`: column -> value of the last one."""
    rows = designs([1.0, 2.0, 3.0, 4.0], [0.1, 0.4, 0.3, 0.9])
    rows[-1] |= changes
    return summary(*rows)


PER_GRAM = "specific_absorption_until_packed_J_per_g"


@pytest.mark.parametrize(
    ("height", "asked", "column", "values"),
    [
        (10e-3, {"budget": [3e-3]}, "absorbed_energy_until_packed_J", [0.4, 0.3, 0.1]),
        (20e-3, {"budget": [5e-3]}, "absorbed_energy_until_packed_J", [0.9, 0.4, 0.3, 0.1]),
        (10e-3, {}, PER_GRAM, [0.225, 0.2, 0.1, 0.1]),
        (10e-3, {"by": "mass_g"}, "mass_g", [1.0, 2.0, 3.0, 4.0]),
    ],
)
def test_best_first_as_in_the_ranking_whatever_the_height(height, asked, column, values):
    found = assess(table(height_m=height), Question(**asked))
    assert (found.column, found.sign) == (column, 1.0 if column == "mass_g" else -1.0)
    assert list(found.by_id.values()) == pytest.approx(values)


@pytest.mark.parametrize(
    ("changes", "doubtful"),
    [
        ({"status": "stopped"}, 0),
        ({"max_crossings": 2}, 1),
        ({"absorbed_energy_within_model_J": 0.2}, 1),
    ],
)
def test_failed_and_marked_designs_have_no_worth_and_do_not_come_near(changes, doubtful):
    found = assess(table(**changes), Question(by="absorbed_energy_J"))
    assert list(found.by_id.values()) == [0.4, 0.3, 0.1]
    assert (found.doubtful, found.missed) == (doubtful, {})
    need = {"min_absorbed": "2 J"}
    found = assess(table(**changes), Question(by="absorbed_energy_J", require=need))
    assert (found.by_id, found.doubtful, len(found.missed)) == ({}, doubtful, 3)


def test_rows_without_the_allowed_force_are_refused():
    rows = summary({}, {}).assign(absorbed_energy_at_50N_J=[0.1, float("nan")])
    with pytest.raises(RankError, match=r"1 rows .* = 50 N; allowed: another --out"):
        assess(rows, Question(allowed_force="50 N"))


def test_front_of_two_aims():
    """The design of 3 g absorbs less than the design of 2 g."""
    found = front(table(), Question(by="absorbed_energy_J"), "mass_g")
    assert list(found["mass_g"]) == [1.0, 2.0, 4.0]
    found = front(table(max_crossings=1), Question(by="absorbed_energy_J"), "mass_g")
    assert list(found["mass_g"]) == [1.0, 2.0]
    found = front(table(), Question(by="mass_g"), "absorbed_energy_J")
    assert list(found["absorbed_energy_J"]) == [0.9, 0.4, 0.1]


def test_keys_of_the_test_are_not_searched():
    check_searched(["lattice.cells_x", "material.name", "loading.direction"])
    for key in ("contact.friction", "lattice.layers", "lattice.imperfection_seed"):
        with pytest.raises(RankError, match=rf"{key}: belongs to the test"):
            check_searched(["lattice.cells_x", key])


def test_columns_without_a_better_value_are_refused():
    check_column("absorbed_energy_at_50N_J")
    for name in ("cells_x", "nonsense"):
        with pytest.raises(RankError, match=name):
            check_column(name)


def test_designs_that_miss_a_requirement_are_sorted_by_how_much():
    """Energies of 0.1, 0.4, 0.3 and 0.9 J, masses of 1 to 4 g."""
    need = {"min_absorbed": "0.35 J", "max_mass": "3 g"}
    found = assess(table(), Question(by="absorbed_energy_J", require=need))
    assert list(found.by_id.values()) == [0.4]
    assert list(found.missed.values()) == pytest.approx([1 / 7, 1 / 3, 5 / 7])


def test_a_front_is_thinned_from_its_best_design_on():
    """Steps of 2 % in both: every third one is kept, and the last."""
    rows = designs([1.02**k for k in range(7)], [0.1 * 1.02**k for k in range(7)])
    found = front(summary(*rows), Question(by="absorbed_energy_J"), "mass_g")
    assert len(found) == 7
    kept = thinned(found, ("mass_g", "absorbed_energy_J"))
    assert list(kept.index) == [found.index[k] for k in (0, 3, 6)]
    alone = thinned(found.assign(mass_g=[1, 2, 3, 4, 5, 6, 7]), ("mass_g", "absorbed_energy_J"))
    assert len(alone) == 7
