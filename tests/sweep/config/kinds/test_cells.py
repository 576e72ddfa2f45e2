"""The table `lattice`: sizes that fit together, openings, and values that follow from others."""

import pytest

from sweep.config.case import Case
from sweep.config.grid import expand
from sweep.config.kinds.table import RefusedError
from tests.support.designs.tables import lattice_with


@pytest.mark.parametrize("walls", ['"", "0.8 mm"', '"0.8 mm", ""'])
def test_a_wall_beside_a_mass_is_refused_though_an_equal_lattice_by_default_is_not(lines, walls):
    (line,) = lines(
        '[lattice]\nmass = "1 g"\n'
        f"[[zip]]\nlattice.wall_thickness = [{walls}]\nloading.strain = [0.5, 0.6]"
    )
    assert line.startswith('lattice.wall_thickness = "0.8 mm": does not fit; allowed: 0.7')
    assert "mm at the mass given; give one of them (1 of 2 combinations, with loading." in line


@pytest.mark.parametrize(
    ("lattice", "message"),
    [
        ({"width": float("inf")}, "finite"),
        ({"slicer": None, "fill_angle": 0.1}, "a key of Cells: width, "),
    ],
)
def test_refused(lattice, message):
    with pytest.raises(RefusedError, match=message):
        Case.of(lattice=lattice)


SHARE, SIZE = 'infill = "20 %"\n', 'cell_size = "4 mm"\n'
KAGOME = 'width = "25 mm"\nheight = "25 mm"\nkind = "kagome"\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (SHARE + "cells = 4", "2, as lattice.infill is 20 %"),
        (SHARE + 'wall_thickness = "0.8 mm"', "0.4 mm, as lattice.infill is 20 %"),
        (SHARE + 'mass = "1 g"', "none where lattice.infill is given"),
        (SIZE + "cells = 4", "3, as lattice.cell_size is 4 mm"),
        (SHARE + SIZE[:-1], "none where lattice.infill is given"),
        ('cell_size = "20 mm"', "12.5 mm wide, or 12.5 mm high"),
        ('cell_size = "10 um"', "1 to 60,000 fit"),
        ('infill = "2 %"', "1 to 60,000 cells"),
        (KAGOME + 'infill = "90 %"', "at least twice as wide"),
        ('mass = "9 g"', "between 2.975e-06 g and 2.479 g"),
        ('wall_thickness = "1e-20 mm"', "at least 2.084e-06 mm, a millionth"),
        ("grading = 1e-300", "at least 0.001, at most 1000"),
        ('kind = "gyroid"\nwall_thickness = "1e-20 mm"', "a millionth"),
        ('kind = "triangle"\nwall_thickness = "1.3 mm"', "1.287 mm"),
        ("perimeters = 9", "at most 8 here"),
        ("solid_layers = 17", "at most 16 here"),
    ],
)
def test_what_is_asked_of_a_lattice_must_go_together(last_refused, text, words):
    assert last_refused(f"[lattice]\n{text}", words)


def test_equal_walls_have_an_equal_id_however_they_are_asked_for():
    by_mass = Case.of(lattice=dict(mass=1e-3))
    by_wall = Case.of(lattice=dict(wall_thickness=by_mass.lattice.wall_thickness))
    assert by_mass.case_id == by_wall.case_id != Case.of().case_id
    plain = lattice_with(cells_x=3, cells_y=3, wall_thickness=0.4e-3, line_width=0.4e-3)
    assert plain.line_width is None


@pytest.mark.parametrize("kind", ["square", "kagome"])
def test_graded_cells_have_twelve_elements_a_wall(kind):
    graded = Case.of(lattice=dict(kind=kind, wall_thickness=0.5e-3, grading=1.5)).lattice
    assert graded.nodes_per_wall == 11
    usual = Case.of(lattice=dict(kind=kind, wall_thickness=0.5e-3)).lattice.nodes_per_wall
    assert usual == (7 if kind == "square" else 11)


def test_a_sweep_of_masses_is_labelled_by_them(load):
    cases = expand(load('[lattice]\nkind = "hex"\n[grid]\nlattice.mass = ["0.8 g", "1 g"]'))
    assert [case.axes["lattice.mass"] for case in cases] == [0.8e-3, 1e-3]
    thin, thick = (case.lattice.wall_thickness for case in cases)
    assert 0.0 < thin < thick
