"""Sheets: sizes that follow from a height or a mass, and refusals."""

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError
from sweep.design.surfaces.names import SHEETS

MM = 1e-3


def case(loading=(), **lattice):
    return Case.of(lattice={"kind": "gyroid"} | lattice, loading=dict(loading))


@pytest.mark.parametrize("way", ["in_plane", "out_of_plane"])
@pytest.mark.parametrize("kind", SHEETS)
def test_whole_steps_of_the_surface_fit_the_height(kind, way):
    made = case({"direction": way}, kind=kind, height=13 * MM, depth=13 * MM, cell_size=6 * MM)
    lattice, cut = made.lattice, SHEETS[kind].straight
    steps = made.height / (cut.step * lattice.period)
    assert steps == pytest.approx(round(steps), rel=1e-12)
    assert lattice.period == pytest.approx(6 * MM, rel=0.2)
    assert made.height == pytest.approx(13 * MM)
    assert lattice.width == pytest.approx(cut.across * lattice.period)
    assert made.footprint[1] == pytest.approx(cut.along * lattice.period)


def test_a_mass_sets_the_thickness():
    lattice = case(mass=1e-4, height=12 * MM).lattice
    density = case().material.density
    assert density * lattice.area * lattice.wall_thickness == pytest.approx(1e-4, rel=1e-12)
    again = Case.of(lattice=lattice.inputs(), loading={})
    assert again.lattice == lattice


def test_walls_are_shells_whichever_way_it_is_pressed():
    for way in ("in_plane", "out_of_plane"):
        made = case({"direction": way, "platen": "clamped"})
        assert made.shells
        assert (made.loading.mode, made.damping.model) == ("displacement", "none")
        assert (made.solver.load_steps, made.lattice.imperfection_seed) == (100, 0)
        assert (made.lattice.period, made.lattice.cells_y) == (pytest.approx(made.height / 2), 2)


SHEET = 'if lattice.kind is "gyroid"'


@pytest.mark.parametrize(
    ("lattice", "words"),
    [
        ({"wall_thickness": 2 * MM}, "below a fifth of the period"),
        ({"cell_size": 200 * MM}, "at most 0.08333 m where 0.0125 m are pressed"),
        ({"nodes_per_wall": 20}, "1 to 11"),
        ({"nodes_per_wall": 0}, "1 to 11"),
        ({"cell_size": 0.1 * MM, "wall_thickness": 0.01 * MM}, "at most 20,000 quads"),
        ({"imperfection": 5.0}, "at most 1, in wall thicknesses"),
        ({"mass": 0.02}, "lattice.mass = .*; allowed"),
        ({"mass": 1e-4, "wall_thickness": 0.1 * MM}, "give one of them"),
        ({"loading": {"mode": "force"}}, f'"displacement" or "impact" {SHEET}'),
        ({"loading": {"platen": "sliding"}}, f'"glued", "clamped" or "contact" {SHEET}'),
        ({"loading": {"striker": "round", "mode": "impact"}}, f'"flat" {SHEET}'),
        ({"loading": {"mode": "impact", "target_mass": 1.0}}, f"none {SHEET}"),
    ],
)
def test_what_a_sheet_does_not_have_is_refused(lattice, words):
    with pytest.raises(RefusedError, match=words):
        case(**lattice)


def test_keys_of_upright_walls_and_of_drawn_ones_do_not_count():
    way = {"direction": "out_of_plane", "platen": "contact"}
    assert case(way, layers=4, symmetry="quarter").case_id == case(way).case_id
    for key, value in {"cells_x": 3, "perimeters": 2, "sides": "free"}.items():
        with pytest.raises(RefusedError):
            case(**{key: value})
    assert case(sides="periodic") == case()


def test_the_period_is_fixed_even_without_friction():
    loading = {"mode": "displacement", "platen": "contact"}
    assert not case(loading).changed(contact={"friction": 0.0}).widens


@pytest.mark.parametrize(
    ("lattice", "where"),
    [
        ('kind = "gyroid"', 'if lattice.kind is "gyroid"'),
        ('slicer = "orca"\npattern = "tpmsd"\ninfill = "20 %"', 'if lattice.pattern is "tpmsd"'),
        ('kind = "hex"\n[loading]\ndirection = "out_of_plane"', 'direction is "out_of_plane"'),
    ],
)
def test_why_walls_are_plates_is_told_in_the_keys_that_are_given(refused, lattice, where):
    text = f'[lattice]\n{lattice}\n[material]\nbend = "fibres"'
    assert refused(text, 'material.bend = "fibres"', '"section" or "linear"', where)
