"""The verb `card`: each infill once, the omitted ones, and its files."""

import pytest

from tests.support.command import crumple


@pytest.fixture
def card(capsys, tmp_path):
    """Call the verb with a config of squares and more words."""

    def call(text, *words):
        path = tmp_path / "own.toml"
        path.write_text(f'[lattice]\nwidth = "30 mm"\nheight = "30 mm"\n{text}')
        return crumple(capsys, "card", str(path), *words)

    return call


def test_each_infill_is_told_once_and_written(card, tmp_path):
    grid = '[grid]\nlattice.cells = [2, 3]\nloading.force = ["1 N", "2 N"]'
    path = tmp_path / "cards" / "own.inp"
    status, out, err = card(grid, "--to", str(path))
    assert (status, err) == (0, "")
    assert sum(line.startswith("square ") for line in out.splitlines()) == 2
    assert out.endswith(f"{path}\n")
    assert path.read_text().count("*MATERIAL") == 2


def test_what_has_no_effective_material_is_left_out_or_refused(card):
    status, out, err = card("[grid]\nlattice.grading = [1.0, 1.5]")
    why = "square has walls that are graded, so that no period repeats; allowed: cells"
    assert status == 0
    assert sum(line.startswith("square ") for line in out.splitlines()) == 1
    assert err.startswith(f"left out: {why}")
    status, out, err = card("grading = 1.5")
    assert (status, out, err.startswith(f"crumple card: {why}")) == (2, "", True)
    status, _, err = card("", "--to", "card.xml")
    assert (status, "unknown ending" in err) == (2, True)
