"""The verb `card`: each infill once, the omitted ones, and its files."""

import pytest

from tests.support.command import crumple

SQUARES = '[lattice]\nwidth = "30 mm"\nheight = "30 mm"\n'


@pytest.fixture
def config(tmp_path):
    """Write a config; its path."""

    def write(text):
        path = tmp_path / "own.toml"
        path.write_text(SQUARES + text)
        return str(path)

    return write


def test_each_infill_is_told_once_and_written(capsys, config, tmp_path):
    grid = '[grid]\nlattice.cells = [2, 3]\nloading.force = ["1 N", "2 N"]'
    path = tmp_path / "cards" / "own.inp"
    status, out, err = crumple(capsys, "card", config(grid), "--to", str(path))
    assert (status, err) == (0, "")
    assert sum(line.startswith("square ") for line in out.splitlines()) == 2
    assert out.endswith(f"{path}\n")
    assert path.read_text().count("*MATERIAL") == 2


def test_what_has_no_effective_material_is_left_out(capsys, config):
    status, out, err = crumple(capsys, "card", config("[grid]\nlattice.grading = [1.0, 1.5]"))
    assert status == 0
    assert sum(line.startswith("square ") for line in out.splitlines()) == 1
    assert err.startswith(
        "left out: square has walls that are graded, so that no period repeats; allowed: cells"
    )


def test_a_config_without_any_is_refused(capsys, config):
    status, out, err = crumple(capsys, "card", config("grading = 1.5"))
    assert (status, out) == (2, "")
    assert err.startswith("crumple card: square has walls that are graded")
    status, _, err = crumple(capsys, "card", config(""), "--to", "card.xml")
    assert (status, "unknown ending" in err) == (2, True)
