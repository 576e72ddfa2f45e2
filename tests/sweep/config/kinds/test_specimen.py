"""Lattices that are refused: flat boxes, closed cells, too many nodes, and lattices without a
period.
"""

import re

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('wall_thickness = "2.5 mm"', "2.083 mm"),
        ('width = "3 m"\nheight = "3 m"\ncells = 300', "at most 60,000"),
        ("cells_y = 4\ncells_x = 7\nnodes_per_wall = 999", "at most 60,000"),
        ('height = "0.01 mm"\nwidth = "40 mm"', "from 1e-05 mm to 10 mm"),
        ('height = "30 m"', "from 1.25e-05 m to 12.5 m"),
        ('mass = "9 g"\ncells = 6\nnodes_per_wall = 999', "at most 60,000"),  # not the mass
    ],
)
def test_what_does_not_fit_is_refused(last_refused, text, words):
    assert last_refused(f"[lattice]\n{text}", words)


def test_a_default_that_does_not_fit_is_called_one(refused):
    assert refused("[lattice]\ncells = 20", "lattice.wall_thickness = 0.8 mm by default", "0.3125")


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


@pytest.mark.parametrize(("kind", "columns"), [("hex", 3), ("kagome", 1)])
def test_rows_need_not_repeat_where_only_sides_do(kind, columns):
    cells = {"kind": kind, "cells_x": columns, "cells_y": 3}
    lattice = cells | {"sides": "periodic", "width": 4e-3, "wall_thickness": 0.2e-3}
    made = Case.of(lattice=lattice, loading={"strain": 0.5}).lattice
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
