"""Lattices that are refused: flat boxes, closed cells, too many nodes, and lattices without a
period.
"""

import re

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError

UNFIT = {
    '[lattice]\nwall_thickness = "2.5 mm"': ('lattice.wall_thickness = "2.5 mm"', "2.083 mm"),
    "[lattice]\ncells = 20": ("lattice.wall_thickness = 0.8 mm by default", "0.3125 mm"),
    '[lattice]\ncells = 300\nwidth = "3 m"\nheight = "3 m"': (
        *("lattice.cells = 300", "at most 50,000", "451,801 here"),
    ),
    "[lattice]\ncells_y = 4\nnodes_per_wall = 999\ncells_x = 6": (
        *("lattice.nodes_per_wall = 999", "at most 50,000", "57,977 here"),
    ),
    '[lattice]\nwidth = "40 mm"\nheight = "0.01 mm"': (
        *('lattice.width = "40 mm"', "from 1e-05 mm to 10 mm"),
    ),
    '[lattice]\nheight = "30 m"': ('lattice.height = "30 m"', "from 1.25e-05 m to 12.5 m"),
}


@pytest.mark.parametrize("text", UNFIT)
def test_what_does_not_fit_is_refused(refused, text):
    assert refused(text, *UNFIT[text])


def test_of_a_lattice_that_is_refused_no_mass_is_told(lines):
    (line,) = lines('[lattice]\ncells = 6\nnodes_per_wall = 999\nmass = "9 g"')
    assert line.startswith("lattice.nodes_per_wall = 999: does not fit; allowed: at most 50,000")


EVEN = "= 3; allowed: an even number if lattice.{} is"
PERIODS = [
    ({"grading": 2.0}, "grading = 2.0; allowed: 1 if lattice.{} is"),
    ({"perimeters": 1}, "perimeters = 1; allowed: 0 if lattice.{} is"),
    ({"solid_layers": 2}, "solid_layers = 2; allowed: 0 if lattice.{} is"),
    ({"infill": 0.2}, "infill = 0.2; allowed: none if lattice.{} is"),
    ({"kind": "reentrant", "orientation": "flat"}, f"cells_x {EVEN}"),
]


@pytest.mark.parametrize("key", ["boundary", "sides"])
@pytest.mark.parametrize(("lattice", "words"), PERIODS)
def test_what_cannot_be_a_period_is_refused(lattice, words, key):
    with pytest.raises(RefusedError, match=re.escape(f"lattice.{words.format(key)}")):
        Case.of(lattice={key: "periodic"} | lattice, loading={"strain": 0.5})


def test_rows_repeat_without_end_and_not_twice():
    with pytest.raises(RefusedError, match=rf"lattice\.cells_y {EVEN.format('boundary')}"):
        Case.of(lattice={"boundary": "periodic", "kind": "hex"}, loading={"strain": 0.5})
    with pytest.raises(RefusedError, match=r'sides = periodic; allowed: "free" if lattice.bound'):
        Case.of(lattice={"boundary": "periodic", "sides": "periodic"}, loading={"strain": 0.5})


def test_rows_need_not_repeat_where_only_sides_do():
    for kind, cells in (("hex", 3), ("kagome", 1)):
        made = Case.of(
            lattice={
                "sides": "periodic",
                "kind": kind,
                "cells_x": cells,
                "cells_y": 3,
                "width": 4e-3,
            }
            | {"wall_thickness": 0.2e-3},
            loading={"strain": 0.5},
        ).lattice
        assert made.outer_size == (4e-3, pytest.approx(12.7e-3))


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('kind = "custom"\nfile = "bar.json"', 'lattice.kind is "custom"'),
        ('slicer = "prusa"\npattern = "grid"\ninfill = "20 %"', "lattice.slicer is given"),
    ],
)
def test_only_cells_repeat_without_end(lines, tmp_path, text, why):
    (tmp_path / "bar.json").write_text('{"nodes_mm": [[0, 0], [10, 0]], "walls": [[0, 1]]}')
    for key in ("boundary", "sides"):
        line = f'lattice.{key} = "periodic": has no effect, as {why}; needed: lattice.kind = '
        found = lines(f'[lattice]\nwidth = "25 mm"\n{key} = "periodic"\n{text}')
        assert any(other.startswith(line) for other in found)
