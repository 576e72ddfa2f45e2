"""Drawings as numbers: heads name quantities and units; missing data are reported."""

import json

import numpy as np
import pytest

from sweep.config.drawings.tables import read_csv, read_json, read_lammps
from sweep.config.faults import MisfitError
from tests.support.designs.drawings import GRID, as_csv, as_lammps, as_nodes


def test_rows_of_lines_and_tables_of_nodes_are_the_same(tmp_path):
    for write in (as_csv, as_nodes):
        lines = read_csv(write(tmp_path / "a.csv"))
        assert lines.unit * lines.ends == pytest.approx(1e-3 * np.array(GRID))
        assert lines.named
        assert lines.thickness is None


def test_heads_may_name_no_unit_and_walls_a_thickness(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text(
        "# of a program\nfrom\tto\tThickness\n0\t1\t.5\n1\t2\t1\n\nX\tY\n0\t0\n9\t0\n0\t9\n"
    )
    lines = read_csv(path)
    assert lines.ends.tolist() == [[[0, 0], [9, 0]], [[9, 0], [0, 9]]]
    assert lines.thickness.tolist() == [0.5, 1.0]
    assert lines.unit is None
    path.write_text("id,x,y\na,0,0\nb,9,0\n\nSource,Target,weight\na,b,1\n")
    assert read_csv(path).ends.tolist() == [[[0, 0], [9, 0]]]
    path.write_text("x1_mm,y1_cm,x2 [mm],y2 (um),thickness_mm\n1,2,3,4,5\n")
    lines = read_csv(path)
    assert lines.ends[0] == pytest.approx(np.array([[1e-3, 2e-2], [3e-3, 4e-6]]))
    assert lines.thickness == pytest.approx([5e-3])


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a,b\n1,2\n", "line 1 has no heads"),
        ("x,y\n1,2\n", "has no walls"),
        ("source,target\n0,1\n", "has no nodes with positions"),
        ("x,y\n0,0\nfrom,to\n0,7\n", 'node "7", which no row has'),
        ("x1_mm,y1,x2,y2\n0,0,1,1\n", "some heads name a unit"),
        ("x1,y1,x2,y2\n0,0,1,1\n0,0,\x1b[1m,1\n", r'line 3: "\\x1b\[1m" is no number'),
        ("x1,y1,x2,y2\n0,0,1\n", 'line 2: "" is no number'),
        ("x1,y1,x2,y2\n0,0,1,inf\n", '"inf" is no number'),
        ("x1,y1,x2,y2\n0,0,1,1\nx1,y1,x2,y2,thickness\n0,0,1,1,1\n", "some walls have a thickness"),
    ],
)
def test_what_is_wrong_in_a_table_is_told(tmp_path, text, told):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(MisfitError, match=told):
        read_csv(tmp_path / "a.csv")


WALLS = {"nodes_mm": [[0, 0], [9, 0], [0, 9]], "walls": [[0, 1], [1, 2]]}


@pytest.fixture
def walls(tmp_path):
    """The lines of a structure of `WALLS` with more parts."""

    def read(**more):
        (tmp_path / "a.json").write_text(json.dumps(WALLS | more))
        return read_json(tmp_path / "a.json")

    return read


def test_a_structure_gives_its_walls_and_what_it_states(walls):
    lines = walls()
    assert (lines.unit, lines.thickness, lines.depth, lines.elements) == (1e-3, None, None, None)
    lines = walls(wall_thickness_mm=[1.0, 2.0], depth_mm=20, subdivide=3)
    assert lines.thickness.tolist() == [1.0, 2.0]
    assert (lines.depth, lines.elements) == (pytest.approx(0.02), 3)


@pytest.mark.parametrize(
    ("more", "told"),
    [
        (
            {"loads": [{"node": 0}], "pins": [1]},
            "has loads, pins; needed: walls alone",
        ),
        ({"subdivide": [1, 2]}, "one number for all walls"),
        ({"walls": [[0, 5]]}, "no such node"),
        ({"wals": 1}, "the nearest is walls"),
    ],
)
def test_what_a_structure_beside_its_walls_has_is_refused(walls, more, told):
    with pytest.raises(MisfitError, match=told):
        walls(**more)


def test_bonds_of_lammps_are_walls_whatever_the_style(tmp_path):
    """Images of a periodic box are put together; without images the style follows from columns."""
    path = as_lammps(tmp_path / "a.data")
    assert read_lammps(path).ends == pytest.approx(np.array(GRID))
    ends = sum(GRID, ())
    styles = {"full": "{k} 1 1 0.5 {x} {y} 0", "": "{k} 1 1 {x} {y} 0", "atomic": "{k} 1 {x} {y} 0"}
    bonds = path.read_text().partition("Bonds")[2]
    for style, row in styles.items():
        atoms = "\n".join(row.format(k=k, x=x, y=y) for k, (x, y) in enumerate(ends, 1))
        path.write_text(f"head\n\nAtoms # {style}\n\n{atoms}\n\nBonds\n{bonds}")
        lines = read_lammps(path)
        assert lines.ends == pytest.approx(np.array(GRID))
        assert lines.unit is None


def test_bonds_around_a_periodic_box_are_left_out(tmp_path):
    """Several words in a comment behind Atoms do not name a style."""
    path = tmp_path / "net.lmp"
    atoms = "1 1 1 0.0 0 0 0\n2 1 1 0.0 4 0 0\n3 1 1 0.0 9 0 0\n4 1 1 0.0 0 3 0"
    bonds = "1 1 1 2\n2 1 2 3\n3 1 3 1\n4 1 1 4"
    box = "net\n\n-0.5 9.5 xlo xhi\n0 3 ylo yhi"
    path.write_text(f"{box}\n\nAtoms # ['id', 'x']\n\n{atoms}\n\nBonds # all\n\n{bonds}\n")
    lines = read_lammps(path)
    assert lines.ends.tolist() == [[[0, 0], [4, 0]], [[4, 0], [9, 0]], [[0, 0], [0, 3]]]
    assert lines.notes == ("left out: 1 bond around the box, longer than half of it",)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("Bonds", "Bands", "the sections Atoms and Bonds"),
        ("# bond", "# body", "an atom of unknown style"),
        ("0.0 0 0 0\n", "1.0 0 0 0\n", "not in a plane"),
        ("1 1 1 2", "1 1 1 99", 'node "99"'),
        ("1 1 1 2", "1 1 1", "no bond"),
        ("0.0 0 0 0\n", "zero 0 0 0\n", '"zero" is no number'),
    ],
)
def test_what_is_wrong_in_lammps_data_is_told(tmp_path, old, new, told):
    path = as_lammps(tmp_path / "a.data")
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(MisfitError, match=told):
        read_lammps(path)
