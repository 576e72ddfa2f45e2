"""Which case a number in the ranking, or the beginning of an id, names."""

import pytest

from sweep.cli.find_case import CaseError, by_id, by_number, is_number
from sweep.ranking.question import Question
from tests.support.results.specimens import designs, summary

QUESTION = Question(budget=["1.5 g", "10 g"])


@pytest.fixture
def two_scenes():
    """Five designs crushed between glued platens, the first two again between loose ones."""
    glued = designs([1.0, 2.0, 3.0, 4.0, 5.0], [0.1, 0.5, 0.4, 0.3, 0.2])
    loose = designs([1.0, 2.0], [0.1, 0.2], platen="contact")
    return summary(*glued, *loose)


@pytest.mark.parametrize(
    ("text", "number"),
    [("1", True), ("999", True), ("0", False), ("012", False), ("1234", False), ("7a", False)],
)
def test_a_number_has_at_most_three_digits(text, number):
    assert is_number(text) == number


def test_number_counts_within_the_first_budget_and_scene(two_scenes):
    row, told = by_number(two_scenes, 1, None, QUESTION)
    assert row["case_id"] == two_scenes["case_id"][0]
    assert told == "number 1 of 1: crushed to 50 %, glued platens, up to 1.5 g"
    assert by_number(two_scenes, 1, None, Question(budget="2 oz"))[1].endswith(", up to 2 oz")
    ids = [
        by_number(two_scenes, n, None, Question(budget="10 g"))[0]["case_id"] for n in range(1, 6)
    ]
    assert ids == list(two_scenes["case_id"].iloc[[1, 2, 3, 4, 0]])


@pytest.mark.parametrize("scene", ["2", "contact", "Crushed to 50 %, contact platens"])
def test_scene_is_a_number_or_words(two_scenes, scene):
    row, told = by_number(two_scenes, 1, scene, Question(budget="10 g"))
    assert row["case_id"] == two_scenes["case_id"][6]
    assert told == "number 1 of 2: crushed to 50 %, contact platens, up to 10 g"


def test_ranking_without_places_has_no_numbers():
    with pytest.raises(CaseError, match="no design is ranked; without CASE, show"):
        by_number(summary({"status": "stopped"}), 1, None, Question())


def test_where_nothing_has_a_place_the_nearest_design_is_named(two_scenes):
    """A scene without places keeps its number."""
    of_scene = QUESTION._replace(budget="0.8 g")
    why = "in crushed to 50 %, contact platens; .* lightest design: case 0+5, ninjaflex"
    with pytest.raises(CaseError, match=why):
        by_number(two_scenes, 1, "2", of_scene)
    question = Question(require={"min_absorbed": "0.4 J"})
    assert by_number(two_scenes, 1, None, question)[0]["case_id"] == two_scenes["case_id"][1]
    with pytest.raises(CaseError, match=r"that of the nearest design: case 0+6, ninjaflex"):
        by_number(two_scenes, 1, "contact", question)


def test_id_begins_so(two_scenes):
    assert by_id(two_scenes, f"{3:016x}")["case_id"] == f"{3:016x}"
    with pytest.raises(CaseError, match=r'"0" begins 7 ids: 0+, '):
        by_id(two_scenes, "0")
