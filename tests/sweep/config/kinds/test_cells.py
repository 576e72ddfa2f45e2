"""The table `lattice`: sizes that fit together, openings, and values that follow from others."""

import pytest

from sweep.config.case import Case
from sweep.config.grid import expand
from sweep.config.kinds.table import RefusedError
from sweep.config.load import load_config
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


UNFIT = {
    'infill = "20 %"\ncells = 4': ("lattice.cells = 4", "2, as lattice.infill is 20 %"),
    'infill = "20 %"\nwall_thickness = "0.8 mm"': (
        *('lattice.wall_thickness = "0.8 mm"', "0.4 mm, as lattice.infill is 20 %"),
    ),
    'infill = "20 %"\nmass = "1 g"': ('lattice.mass = "1 g"', "none where lattice.infill is given"),
    'cell_size = "4 mm"\ncells = 4': ("lattice.cells = 4", "3, as lattice.cell_size is 4 mm"),
    'cell_size = "4 mm"\ninfill = "20 %"': (
        'lattice.cell_size = "4 mm"',
        "none where lattice.infill is given",
    ),
    'cell_size = "20 mm"': ('lattice.cell_size = "20 mm"', "12.5 mm wide, or 12.5 mm high"),
    'cell_size = "10 um"': ('lattice.cell_size = "10 um"', "1 to 50,000 fit"),
    'infill = "2 %"': ('lattice.infill = "2 %"', "1 to 50,000 cells", "0.4 mm"),
    'infill = "90 %"\nwidth = "25 mm"\nheight = "25 mm"\nkind = "kagome"': (
        *('lattice.infill = "90 %"', "at least twice as wide"),
    ),
    'mass = "1 g"\nwall_thickness = "0.8 mm"': (
        *('lattice.wall_thickness = "0.8 mm"', "0.7446 mm", "one of them"),
    ),
    'mass = "9 g"': ('lattice.mass = "9 g"', "between 2.975e-06 g and 2.479 g"),
    'wall_thickness = "1e-20 mm"': (
        *('lattice.wall_thickness = "1e-20 mm"', "at least 2.084e-06 mm", "a millionth"),
    ),
    "grading = 1e-300": ("lattice.grading = 1e-300", "at least 0.001, at most 1000"),
    'kind = "gyroid"\nwall_thickness = "1e-20 mm"': (
        *('lattice.wall_thickness = "1e-20 mm"', "at least", "a millionth"),
    ),
    'kind = "triangle"\nwall_thickness = "1.3 mm"': (
        *('lattice.wall_thickness = "1.3 mm"', "below", "1.287 mm"),
    ),
    "perimeters = 9": ("lattice.perimeters = 9", "at most 8 here", "3.367 mm"),
    "solid_layers = 17": ("lattice.solid_layers = 17", "at most 16 here", "3.367 mm"),
}


@pytest.mark.parametrize("text", UNFIT)
def test_what_is_asked_of_a_lattice_must_go_together(refused, text):
    assert refused(f"[lattice]\n{text}", *UNFIT[text])


def test_equal_walls_have_an_equal_id_however_they_are_asked_for():
    by_mass = Case.of(lattice=dict(mass=1e-3))
    by_wall = Case.of(lattice=dict(wall_thickness=by_mass.lattice.wall_thickness))
    assert by_mass.case_id == by_wall.case_id != Case.of().case_id
    by_share = Case.of(lattice=dict(infill=0.2))
    assert by_share.case_id != Case.of().case_id
    plain = lattice_with(cells_x=3, cells_y=3, wall_thickness=0.4e-3, line_width=0.4e-3)
    assert plain.line_width is None


def test_a_sweep_of_masses_is_labelled_by_them(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text('[lattice]\nkind = "hex"\n[grid]\nlattice.mass = ["0.8 g", "1 g"]')
    cases = expand(load_config(path))
    assert [case.axes["lattice.mass"] for case in cases] == [0.8e-3, 1e-3]
    thin, thick = (case.lattice.wall_thickness for case in cases)
    assert 0.0 < thin < thick


def test_free_sides_keep_their_ids():
    for key in ("boundary", "sides"):
        assert Case.of().case_id == Case.of(lattice={key: "free"}).case_id
    press = dict(mode="displacement")
    tied = Case.of(lattice=dict(sides="periodic"), loading=press)
    assert tied.case_id != Case.of(loading=press).case_id
