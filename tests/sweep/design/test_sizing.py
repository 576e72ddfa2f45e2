"""Outlines, grading, and lattices asked for by a share of infill or by their mass."""

import numpy as np
import pytest

from sweep.config.case import Case, Lattice, Loading, Material
from sweep.config.grid import expand
from sweep.config.units import ConfigError, load_config
from sweep.design.box import infill_walls
from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.design.network import mass, relative_density
from sweep.design.sizing import infill_share
from sweep.scene.lattice import build_scene

T, W, H = 0.8e-3, 12.5e-3, 12.5e-3


def refusals(tmp_path, text):
    path = tmp_path / "sweep.toml"
    path.write_text(text)
    with pytest.raises(ConfigError) as caught:
        load_config(path)
    return str(caught.value).splitlines()


@pytest.mark.parametrize(
    ("lines", "sides", "caps"),
    [
        ({"perimeters": 3}, 1.2e-3, 1.2e-3),
        ({"perimeters": 2, "line_width": 0.5e-3}, 1.0e-3, 1.0e-3),
        ({"solid_layers": 4}, T, 0.8e-3),
        ({"perimeters": 1, "solid_layers": 5, "layer_height": 0.3e-3}, 0.4e-3, 1.5e-3),
    ],
)
def test_an_outline_is_as_thick_as_its_lines(lines, sides, caps):
    """Outer box less the openings: those at the sides lose half of the outline."""
    lattice = Lattice(**lines)
    network, pitch = build_network(lattice.geometry), W / 3
    across = [pitch - 0.5 * (sides + T), pitch - T, pitch - 0.5 * (sides + T)]
    up = [pitch - 0.5 * (caps + T), pitch - T, pitch - 0.5 * (caps + T)]
    area = (W + sides) * (H + caps) - sum(across) * sum(up)
    assert network.printed_area == pytest.approx(area, rel=1e-12)
    box = (W + sides) * (H + caps)
    assert relative_density(network, lattice.outer_size) == pytest.approx(area / box, rel=1e-12)
    assert lattice.outer_size == pytest.approx((W + sides, H + caps))


def test_platens_touch_an_outline():
    lattice = Lattice(solid_layers=6)
    scene = build_scene(Case(lattice=lattice, loading=Loading(force=1.0, platen="contact")))
    thickness = scene.terms.contact.node_thickness[scene.mesh.points[:, 1] == 0.0].max()
    assert 0.8e-3 < thickness < 1.2001e-3
    assert scene.x_rest[-2] == pytest.approx(-0.5 * thickness)


@pytest.mark.parametrize("kind", families())
@pytest.mark.parametrize("ratio", [0.25, 1.0, 3.0])
def test_grading_is_linear_and_keeps_the_mean(kind, ratio):
    lattice = Lattice(kind=kind, wall_thickness=0.3e-3, grading=ratio)
    network = build_network(lattice.geometry)
    length, height = infill_walls(lattice.geometry)
    thickness = network.wall_thickness
    assert thickness @ length == pytest.approx(0.3e-3 * length.sum(), rel=1e-12)
    slope, below = np.polyfit(height, thickness, 1)
    np.testing.assert_allclose(slope * height + below, thickness, rtol=1e-9)
    assert (below + slope) / below == pytest.approx(ratio)


@pytest.mark.parametrize("kind", families())
@pytest.mark.parametrize("extra", [{}, {"perimeters": 1}, {"grading": 2.0}])
def test_a_mass_is_met(kind, extra):
    lattice = Lattice(kind=kind, width=0.02, height=0.02, mass=1.4e-3, **extra)
    made = Case(lattice=lattice, material=Material(name="ninjaflex")).lattice
    found = mass(build_network(made.geometry), made.depth, Material().density)
    assert found == pytest.approx(1.4e-3, rel=1e-12)
    again = Case.model_validate(Case(lattice=made).model_dump())
    assert again.lattice.wall_thickness == pytest.approx(made.wall_thickness, rel=1e-12)


def test_equal_walls_have_an_equal_id_however_they_are_asked_for():
    by_mass = Case(lattice=Lattice(mass=1e-3))
    by_wall = Case(lattice=Lattice(wall_thickness=by_mass.lattice.wall_thickness))
    assert by_mass.case_id == by_wall.case_id != Case().case_id
    by_share = Case(lattice=Lattice(infill=0.2))
    assert by_share.case_id != Case().case_id
    plain = Lattice(cells_x=3, cells_y=3, wall_thickness=0.4e-3, line_width=0.4e-3)
    assert plain.line_width is None


@pytest.mark.parametrize("kind", families())
@pytest.mark.parametrize("share", [0.1, 0.25])
def test_a_share_of_infill_is_met_as_nearly_as_cells_allow(kind, share):
    box = {"width": 80e-3, "height": 60e-3, "line_width": 0.45e-3}
    lattice = Lattice(kind=kind, infill=share, perimeters=2, **box)
    assert lattice.wall_thickness == 0.45e-3
    assert infill_share(lattice.geometry) == pytest.approx(share, rel=0.1)


def test_share_of_a_square_grid_is_that_of_slicers():
    """Two lines of width w each pitch, in either direction; those on the outline are no infill."""
    lattice = Lattice(width=0.1, height=0.1, infill=0.2, perimeters=1)
    assert (lattice.cells_x, lattice.cells_y) == (26, 26)
    assert infill_share(lattice.geometry) == pytest.approx(2 * 0.4e-3 / 0.1 * 25)


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
        (
            'orientation = "flat"',
            'lattice.orientation = "flat": has no effect, as lattice.kind is "square"',
        ),
        (
            'line_width = "0.5 mm"',
            'lattice.line_width = "0.5 mm": has no effect, as there are neither'
            " lattice.perimeters nor a lattice.infill",
        ),
        (
            'perimeters = 1\nlayer_height = "0.5 mm"',
            'lattice.layer_height = "0.5 mm": has no effect, as lattice.solid_layers is 0',
        ),
    ],
)
def test_what_does_not_fit_is_one_line(tmp_path, text, line):
    assert refusals(tmp_path, f"[lattice]\n{text}") == [line]


def test_a_sweep_of_masses_is_labelled_by_them(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text('[lattice]\nkind = "hex"\n[grid]\nlattice.mass = ["0.8 g", "1 g"]')
    cases = expand(load_config(path))
    assert [case.axes["lattice.mass"] for case in cases] == [0.8e-3, 1e-3]
    thin, thick = (case.lattice.wall_thickness for case in cases)
    assert 0.0 < thin < thick
