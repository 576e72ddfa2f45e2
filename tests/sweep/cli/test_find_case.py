"""Which case a number in the ranking, or the beginning of an id, names."""

import pytest

from sweep.cli.find_case import by_id, by_number, is_number
from sweep.cli.refusals import ArgumentError
from sweep.ranking.question import Question
from tests.support.results.specimens import designs, summary


@pytest.fixture
def two_scenes():
    """Five designs crushed between glued platens, the first two again between loose ones."""
    glued = designs([1.0, 2.0, 3.0, 4.0, 5.0], [0.1, 0.5, 0.4, 0.3, 0.2])
    loose = designs([1.0, 2.0], [0.1, 0.2], platen="contact")
    return summary(*glued, *loose)


def test_a_number_has_at_most_three_digits():
    assert all(map(is_number, ("0", "1", "-1", "999")))
    assert not any(map(is_number, ("", "012", "1234", "7a")))


def test_number_counts_within_the_first_budget_and_scene(two_scenes):
    row, told = by_number(two_scenes, 1, None, Question(budget=["1.5 g", "10 g"]))
    assert row["case_id"] == two_scenes["case_id"][0]
    assert told.endswith(", up to 1.5 g")
    for number in (-1, 0, 2):
        with pytest.raises(ArgumentError, match=rf"no number {number} .*; allowed: 1 to 1, or"):
            by_number(two_scenes, number, None, Question(budget=["1.5 g", "10 g"]))
    whole = Question(budget="10 g")
    ids = [by_number(two_scenes, n, None, whole)[0]["case_id"] for n in range(1, 6)]
    assert ids == list(two_scenes["case_id"].iloc[[1, 2, 3, 4, 0]])


@pytest.mark.parametrize("scene", ["2", "contact", "Crushed to 50 %, contact platens"])
def test_scene_is_a_number_or_words(two_scenes, scene):
    """One without places keeps its number."""
    row, told = by_number(two_scenes, 1, scene, Question(budget="10 g"))
    assert row["case_id"] == two_scenes["case_id"][6]
    assert told.startswith("number 1 of 2: crushed to 50 %, contact platens")
    with pytest.raises(ArgumentError, match=r"to 50 %, contact platens; .* lightest design"):
        by_number(two_scenes, 1, scene, Question(budget="0.8 g"))
    with pytest.raises(ArgumentError, match=r"that of the nearest design: case 0+6, ninjaflex"):
        by_number(two_scenes, 1, scene, Question(require={"min_absorbed": "0.4 J"}))


def test_ranking_without_places_has_no_numbers():
    with pytest.raises(ArgumentError, match="no design is ranked; without CASE, show"):
        by_number(summary({"status": "stopped"}), 1, None, Question())


def test_id_begins_so(two_scenes):
    assert by_id(two_scenes, f"{3:016x}")["case_id"] == f"{3:016x}"
    with pytest.raises(ArgumentError, match=r'"00" begins 7 ids: 0+, '):
        by_id(two_scenes, "00")
