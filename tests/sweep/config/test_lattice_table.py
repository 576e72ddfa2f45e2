"""The table `lattice`: sizes that go together, openings, what of it follows from the rest."""

import math
import re

import pytest
from pydantic import ValidationError

from sweep.config.case import Case, Lattice
from sweep.config.grid import expand
from sweep.config.units import load_config
from sweep.design.slicer.network import extruded_area

UNFIT = {
    '[lattice]\nwall_thickness = "2.5 mm"': (
        'lattice.wall_thickness = "2.5 mm": does not fit; allowed: below half the width of'
        " the narrowest cell, 2.083 mm here"
    ),
    "[lattice]\ncells = 20": (
        "lattice.wall_thickness = 0.0008 m by default: does not fit; allowed: below half the"
        " width of the narrowest cell, 0.0003125 m here"
    ),
    '[lattice]\ncells = 300\nwidth = "3 m"\nheight = "3 m"': (
        "lattice.cells = 300: does not fit; allowed: at most 50,000 nodes in all, 451,801 here"
    ),
    "[lattice]\ncells_y = 4\nnodes_per_wall = 999\ncells_x = 6": (
        "lattice.nodes_per_wall = 999: does not fit; allowed: at most 50,000 nodes in all,"
        " 57,977 here"
    ),
    '[lattice]\nwidth = "40 mm"\nheight = "0.01 mm"': (
        'lattice.width = "40 mm": does not fit; allowed: from 1e-05 mm to 10 mm, a thousandth to'
        " a thousand times the height"
    ),
    '[lattice]\nheight = "30 m"': (
        'lattice.height = "30 m": does not fit; allowed: from 1.25e-05 m to 12.5 m, a thousandth'
        " to a thousand times the width"
    ),
}


@pytest.mark.parametrize("text", UNFIT)
def test_what_does_not_fit_is_one_line(lines, text):
    assert lines(text) == [UNFIT[text]]


def test_of_a_lattice_that_is_refused_no_mass_is_told(lines):
    (line,) = lines('[lattice]\ncells = 6\nnodes_per_wall = 999\nmass = "9 g"')
    assert line.startswith("lattice.nodes_per_wall = 999: does not fit; allowed: at most 50,000")


@pytest.mark.parametrize("walls", ['"", "0.8 mm"', '"0.8 mm", ""'])
def test_a_wall_beside_a_mass_is_refused_though_an_equal_lattice_by_default_is_not(lines, walls):
    (line,) = lines(
        '[lattice]\nmass = "1 g"\n'
        f"[[zip]]\nlattice.wall_thickness = [{walls}]\nloading.strain = [0.5, 0.6]"
    )
    assert line.startswith('lattice.wall_thickness = "0.8 mm": does not fit; allowed: 0.7')
    assert "mm at the mass given; give one of them (1 of 2 combinations, with loading." in line


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: Lattice(wall_thickness=2.1e-3),
            "the narrowest cell, 0.002083 m",
        ),
        (lambda: Lattice(cells_x=True), "valid integer"),
        (lambda: Lattice(width=float("inf")), "finite"),
        (lambda: Lattice(colour=1), "not permitted"),
    ],
)
def test_refused(make, message):
    with pytest.raises(ValidationError, match=message):
        make()


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (
            'infill = "20 %"\ncells = 4',
            "lattice.cells = 4: does not fit; allowed: 2, as lattice.infill is 20 %; give one of"
            " them",
        ),
        (
            'infill = "20 %"\nwall_thickness = "0.8 mm"',
            'lattice.wall_thickness = "0.8 mm": does not fit; allowed: 0.4 mm, as lattice.infill is'
            " 20 %; give one of them",
        ),
        (
            'infill = "20 %"\nmass = "1 g"',
            'lattice.mass = "1 g": does not fit; allowed: none where lattice.infill is given',
        ),
        (
            'infill = "2 %"',
            'lattice.infill = "2 %": does not fit; allowed: a share that 1 to 50,000 cells fill'
            " with lines of 0.0004 m in this box",
        ),
        (
            'infill = "90 %"\nwidth = "50 mm"\nheight = "50 mm"\nkind = "kagome"',
            'lattice.infill = "90 %": does not fit; allowed: a share that leaves cells at least'
            " twice as wide as their walls",
        ),
        (
            "infill = 0.2",
            "lattice.infill = 0.2: a bare number; allowed: a share in percent, such as"
            ' "20 %", above 0, below 1',
        ),
        (
            'mass = "1 g"\nwall_thickness = "0.8 mm"',
            'lattice.wall_thickness = "0.8 mm": does not fit; allowed: 0.7446 mm at the mass'
            " given; give one of them",
        ),
        (
            'mass = "9 g"',
            'lattice.mass = "9 g": does not fit; allowed: between 2.975e-06 g and 2.479 g with'
            " these cells",
        ),
        (
            'kind = "triangle"\nwall_thickness = "1.3 mm"',
            'lattice.wall_thickness = "1.3 mm": does not fit; allowed: below half the width of the'
            " narrowest cell, 1.288 mm here",
        ),
        (
            "grading = 4.0\ncells = 4\nwall_thickness = 1.2",
            "lattice.wall_thickness = 1.2: a bare number; allowed: a length with a unit, such as"
            ' "0.8 mm", above 0',
        ),
        (
            "perimeters = 9",
            "lattice.perimeters = 9: does not fit; allowed: at most 8 here, thinner in all than"
            " cells are open, 0.003367 m",
        ),
        (
            "solid_layers = 17",
            "lattice.solid_layers = 17: does not fit; allowed: at most 16 here, thinner in all than"
            " cells are open, 0.003367 m",
        ),
    ],
)
def test_what_is_asked_of_a_lattice_must_go_together(lines, text, line):
    assert lines(f"[lattice]\n{text}") == [line]


def test_equal_walls_have_an_equal_id_however_they_are_asked_for():
    by_mass = Case(lattice=Lattice(mass=1e-3))
    by_wall = Case(lattice=Lattice(wall_thickness=by_mass.lattice.wall_thickness))
    assert by_mass.case_id == by_wall.case_id != Case().case_id
    by_share = Case(lattice=Lattice(infill=0.2))
    assert by_share.case_id != Case().case_id
    plain = Lattice(cells_x=3, cells_y=3, wall_thickness=0.4e-3, line_width=0.4e-3)
    assert plain.line_width is None


def test_a_sweep_of_masses_is_labelled_by_them(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text('[lattice]\nkind = "hex"\n[grid]\nlattice.mass = ["0.8 g", "1 g"]')
    cases = expand(load_config(path))
    assert [case.axes["lattice.mass"] for case in cases] == [0.8e-3, 1e-3]
    thin, thick = (case.lattice.wall_thickness for case in cases)
    assert 0.0 < thin < thick


ENDLESS = [
    ({"grading": 2.0}, "lattice.grading = 2.0; allowed: 1"),
    ({"perimeters": 1}, "lattice.perimeters = 1; allowed: 0"),
    ({"solid_layers": 2}, "lattice.solid_layers = 2; allowed: 0"),
    ({"infill": 0.2}, "lattice.infill = 0.2; allowed: none"),
    ({"kind": "hex"}, "lattice.cells_y = 3; allowed: an even number"),
    ({"kind": "hex", "orientation": "flat"}, "lattice.cells_x = 3; allowed: an even number"),
]


@pytest.mark.parametrize(("lattice", "words"), ENDLESS)
def test_what_has_no_endless_lattice_is_refused(lattice, words):
    with pytest.raises(ValidationError, match=re.escape(words)):
        Case(lattice={"boundary": "periodic"} | lattice, loading={"strain": 0.5})


def test_a_structure_of_ones_own_is_not_repeated(tmp_path):
    (tmp_path / "bar.json").write_text('{"nodes_mm": [[0, 0], [10, 0]], "walls": [[0, 1]]}')
    words = 'lattice.boundary = periodic; allowed: "free"'
    with pytest.raises(ValidationError, match=re.escape(words)):
        Lattice(kind="custom", file=str(tmp_path / "bar.json"), boundary="periodic")


def test_free_sides_keep_their_ids():
    assert Case().case_id == Case(lattice=Lattice(boundary="free")).case_id


SLICED = '[lattice]\nwidth = "20 mm"\nheight = "20 mm"\nslicer = "prusa"\n'
GRID = f'{SLICED}pattern = "grid"\n'


def sliced(**lattice):
    usual = {"slicer": "prusa", "pattern": "grid", "width": 20e-3, "height": 20e-3}
    return Lattice(**usual | {"infill": 0.2} | lattice)


def test_a_slicer_fills_in_its_own_defaults():
    """Lines of 1.125 nozzles, at 45 degrees; Cura's are as wide as the nozzle, and are w apart."""
    found = sliced()
    assert found.line_width == pytest.approx(0.45e-3)
    assert (found.layer_height, found.perimeters) == (0.2e-3, 2)
    assert found.fill_angle == pytest.approx(math.pi / 4.0)
    assert found.wall_thickness == found.line == pytest.approx(0.407e-3, abs=0.5e-6)
    assert found.fill_distance == pytest.approx(2.0 * found.line / 0.2)
    assert found.outline == (2 * found.line,) * 2
    assert found.geometry.sliced.inset == pytest.approx((1.0 - 0.25) * found.line)
    assert sliced(nozzle=0.6e-3).line_width == pytest.approx(0.675e-3)
    cura = sliced(slicer="cura")
    assert cura.wall_thickness == cura.line == cura.line_width == 0.4e-3
    assert cura.fill_distance == pytest.approx(2.0 * 0.4e-3 / 0.2)


def test_walls_of_a_printed_honeycomb_are_four_thirds_of_a_line():
    found = sliced(pattern="honeycomb")
    assert found.wall_thickness == pytest.approx(4.0 * found.line / 3.0)
    assert found.fill_distance == pytest.approx(2.0 * found.line / 0.2)


def test_names_of_keys_and_patterns_are_the_slicers(load):
    (case,) = expand(
        load(
            '[lattice]\nslicer = "orca"\npattern = "tri-hexagon"\ninfill = "15 %"\n'
            'extrusion_width = "0.42 mm"\nfill_angle = "30 deg"\nwidth = "25 mm"\nheight = "25 mm"'
        )
    )
    assert case.lattice.line_width == 0.42e-3
    assert math.degrees(case.lattice.fill_angle) == pytest.approx(30.0)
    assert case.lattice.geometry.sliced.pattern == "stars"


def test_what_is_printed_tells_designs_apart():
    ids = {
        Case(lattice=sliced(**lattice)).case_id
        for lattice in (
            *({}, {"infill": 0.21}, {"fill_angle": 0.5}, {"slicer": "cura"}, {"perimeters": 3}),
            *({"pattern": "stars"}, {"layer_height": 0.15e-3}),
        )
    }
    assert len(ids) == 7
    labelled = sliced(nozzle=0.5e-3, line_width=0.45e-3, printable=True)
    assert Case(lattice=labelled).case_id == Case(lattice=sliced(line_width=0.45e-3)).case_id


@pytest.mark.parametrize("pattern", ["grid", "triangles", "stars", "honeycomb"])
def test_a_mass_is_that_which_is_extruded(pattern):
    """At any density of the material."""
    case = Case(lattice=sliced(pattern=pattern, mass=2.1e-3, infill=None))
    grams = case.material.density * case.lattice.depth * extruded_area(case.lattice.geometry)
    assert grams == pytest.approx(2.1e-3, rel=1e-9)
    again = Case(lattice=sliced(pattern=pattern, infill=case.lattice.infill))
    assert again.case_id == case.case_id


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (SLICED + 'infill = "20 %"', "lattice.pattern is missing; needed: "),
        (GRID, 'lattice.infill is missing; needed: a share such as "20 %", or a lattice.mass'),
        (
            SLICED + 'infill = "20 %"\npattern = "gyroid"',
            'lattice.pattern = "gyroid": does not fit; allowed: "grid", "triangles", "stars",'
            ' "honeycomb", "alignedrectilinear"; gyroid is no prism, as its walls wander from layer'
            " to layer: the nearest is honeycomb",
        ),
        (
            GRID.replace("prusa", "cura").replace("grid", "gyroid") + 'infill = "20 %"',
            'lattice.pattern = "gyroid": does not fit; allowed: "grid", "triangles", "trihexagon";'
            " gyroid is no prism, as its walls wander from layer to layer: the nearest is grid",
        ),
        (
            SLICED + 'infill = "20 %"\npattern = "stripes"',
            'lattice.pattern = "stripes": does not fit; allowed: "grid", "triangles", "stars",'
            ' "honeycomb", "alignedrectilinear"',
        ),
        (
            GRID + 'infill = "20 %"\nkind = "hex"',
            'lattice.kind = "hex": does not fit; allowed: none, as lattice.slicer is given and'
            " lattice.pattern is grid",
        ),
        (
            GRID + 'infill = "20 %"\nwall_thickness = "0.8 mm"',
            'lattice.wall_thickness = "0.8 mm": does not fit; allowed: 0.4071 mm, as lattice.slicer'
            " is given",
        ),
        (
            GRID + 'infill = "20 %"\nperimeters = 0',
            "lattice.perimeters = 0: does not fit; allowed: 1 to 23, as lattice.slicer is given:"
            " perimeters hold the infill",
        ),
        (
            GRID + 'infill = "20 %"\nlayer_height = "0.5 mm"',
            'lattice.layer_height = "0.5 mm": does not fit; allowed: at most the line width,'
            " 0.45 mm",
        ),
        (
            SLICED + 'pattern = "stars"\ninfill = "60 %"',
            'lattice.infill = "60 %": does not fit; allowed: a share that leaves cells at least'
            " twice as wide as their walls",
        ),
        (
            GRID + 'mass = "1 g"',
            'lattice.mass = "1 g": does not fit; allowed: between 1.249 g and 6.301 g as',
        ),
        (
            GRID + 'mass = "2 g"\ninfill = "20 %"',
            'lattice.mass = "2 g": does not fit; allowed: none where lattice.infill is given',
        ),
        (
            GRID + 'infill = "20 %"\ncells = 3',
            "lattice.cells = 3: does not fit; allowed: 5, as lattice.slicer is given",
        ),
        (
            '[lattice]\npattern = "grid"',
            'lattice.pattern = "grid": has no effect, as lattice.slicer is not given',
        ),
    ],
)
def test_what_is_asked_of_a_slicer_must_go_together(lines, text, line):
    assert lines(text)[0].startswith(line)


def test_lines_side_by_side_are_as_many_times_farther_apart():
    """OrcaSlicer keeps the share: m lines are m s thick, at m times the distance."""
    one, three = (sliced(slicer="orca", fill_multiline=lines, infill=0.2) for lines in (1, 3))
    assert three.wall_thickness == pytest.approx(3.0 * one.wall_thickness)
    assert three.fill_distance == pytest.approx(3.0 * one.fill_distance)
    assert three.outline == one.outline
    areas = [lattice.geometry.sliced.share for lattice in (one, three)]
    assert areas == pytest.approx([0.2, 0.2])
    assert Case(lattice=one).case_id == Case(lattice=sliced(slicer="orca", infill=0.2)).case_id


@pytest.mark.parametrize(
    "wish", [{"slicer": "prusa"}, {"slicer": "cura"}, {"slicer": "orca", "pattern": "honeycomb"}]
)
def test_several_lines_are_of_orca_and_of_patterns_with_a_known_relation(wish):
    with pytest.raises(ValidationError, match=r"fill_multiline|1; more with lattice.slicer"):
        sliced(**{"pattern": "grid", "infill": 0.2, "fill_multiline": 2} | wish)
    with pytest.raises(ValidationError, match=r"1 without lattice.slicer"):
        Lattice(fill_multiline=2)


def test_a_slicer_prints_no_endless_lattice():
    with pytest.raises(ValidationError, match=re.escape('"free" if lattice.slicer is given')):
        sliced(boundary="periodic")
