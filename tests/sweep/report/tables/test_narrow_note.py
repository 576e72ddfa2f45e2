"""What is said of narrow lattices."""

from sweep.report.tables.narrow_note import narrow_note


def test_only_the_patterns_of_the_ranking_are_told_with_their_numbers():
    (words,) = narrow_note(("diamond", "circle"))
    assert "fewer than 8 cells" in words
    assert "+52 % (diamond)" in words
    assert "hex" not in words


def test_nothing_is_said_of_wide_lattices():
    assert list(narrow_note(())) == []
