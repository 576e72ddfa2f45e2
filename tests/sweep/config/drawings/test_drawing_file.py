"""A file of any format is read once, within bounds; its walls are in one piece."""

import os

import pytest

from sweep.config.drawings import drawing_file
from sweep.config.drawings.drawing_file import MOST_BYTES, read_drawing
from sweep.config.structures.structure_file import StructureError
from tests.support.designs.drawings import GRID, as_csv

HEADS = "x1,y1,x2,y2\n"


def test_a_file_is_read_again_when_it_changes(tmp_path):
    path = as_csv(tmp_path / "A.CSV")
    first = read_drawing(path)
    assert (len(first.network.joints), len(first.network.walls)) == (16, 24)
    assert read_drawing(path) is first
    as_csv(path, GRID[:-1])
    os.utime(path, (0, 0))
    assert len(read_drawing(path).network.walls) == 21


PIECES = "0,0,9,0\n0,0,0,9\n3,3,4,4\n"
WALLS = HEADS.strip() + ",thickness\n0,0,9,9,0\n0,0,0,9,1\n"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (HEADS + PIECES, "in 2 pieces: nothing holds the walls at 3, 3 of its units from"),
        ("x1_in,y1_in,x2_in,y2_in\n" + PIECES, "nothing holds the walls at 76.2, 76.2 mm from"),
        (HEADS + "0,0,9,0\n", "its lines span 9 x 0 of its units"),
        (HEADS, "has 0 lines"),
        (HEADS + "0,0,1e300,1\n", "reaches farther than 1e"),
        (WALLS, "a wall of thickness 0"),
        (HEADS + "0,0,9,9\n" * 200, "has 200 lines"),
        (" " * (MOST_BYTES + 1), "larger than 8 MB"),
    ],
)
def test_what_is_no_lattice_is_refused(tmp_path, monkeypatch, text, told):
    monkeypatch.setattr(drawing_file, "MOST_LINES", 100)
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(StructureError, match=told):
        read_drawing(tmp_path / "a.csv")


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("a.stl", "not the name of a drawing"),
        ("folder.svg", "not a file"),
        ("b.csv", "No such file"),
        ("\0.csv", "no path"),
    ],
)
def test_what_is_no_file_of_a_drawing_is_refused(tmp_path, name, told):
    (tmp_path / "a.stl").touch()
    (tmp_path / "folder.svg").mkdir()
    with pytest.raises(StructureError, match=rf"{told}.*; needed: the path of a \.svg, \.dxf"):
        read_drawing(tmp_path / name)
