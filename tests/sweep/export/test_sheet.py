"""Parts of sheets: closed, of the size of the panel, as heavy as theory says, and laid to print."""

from functools import cache
from math import pi

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.export.errors import ExportError
from sweep.export.export import export_case
from sweep.export.sheet import sheet_block, sheet_panel

MM = 1e-3
SHEETS = {
    "gyroid": dict(kind="gyroid", cell_size=6 * MM),
    "schwarz_p": dict(kind="schwarz_p", cell_size=6 * MM),
    "schwarz_d": dict(kind="schwarz_d", cell_size=6 * MM),
    "straight": dict(slicer="orca", pattern="gyroid", infill=0.2),
    "turned": dict(slicer="orca", pattern="gyroid", infill=0.2, fill_angle=0.0),
    "tpmsd": dict(slicer="orca", pattern="tpmsd", infill=0.2),
}
EULER = {"gyroid": -8, "schwarz_p": -4, "schwarz_d": -16}  # characteristic of a period


def case(name, direction="out_of_plane"):
    height = dict(height=6 * MM, depth=6 * MM)
    return Case.of(lattice=height | SHEETS[name], loading={"direction": direction})


@cache
def printed(name, direction):
    made = case(name, direction)
    width, depth = made.footprint
    return sheet_panel(made, (1.5 * width, depth))[0]


@pytest.mark.parametrize("name", ["gyroid", "schwarz_p", "schwarz_d"])
def test_walls_have_the_volume_between_parallel_surfaces(name):
    """Steiner: volume = area x t + t^3 / 12 x 2 pi x the Euler characteristic."""
    lattice = case(name).lattice
    t, periods = lattice.wall_thickness, 1.5 * lattice.depth / lattice.period
    volume = 1.5 * lattice.area * t + 2 * pi * EULER[name] * periods * t**3 / 12
    body = printed(name, "out_of_plane")
    assert body.is_closed
    assert 1e-9 * body.volume == pytest.approx(volume, rel=0.015)


@pytest.mark.parametrize("name", ["straight", "turned", "tpmsd"])
@pytest.mark.parametrize("direction", ["in_plane", "out_of_plane"])
def test_printed_walls_have_the_volume_of_their_lines(name, direction):
    body, volume = printed(name, direction), 1.5 * case(name, direction).lattice.extruded
    assert body.is_closed
    assert 1e-9 * body.volume == pytest.approx(volume, rel=0.02)


@pytest.mark.parametrize("direction", ["in_plane", "out_of_plane"])
def test_the_print_axis_is_z(direction):
    """There lines are thinnest where the sheet lies flattest; the pressed height is y or z."""
    made, body = case("turned", direction), printed("turned", direction)
    width, depth = np.array(made.footprint) * (1.5, 1.0)
    size = (width, depth, 6 * MM) if made.along else (width, 6 * MM, depth)
    np.testing.assert_allclose(body.points.min(axis=0), 0.0, atol=2e-3)
    np.testing.assert_allclose(body.points.max(axis=0), np.array(size) / MM, atol=2e-3)


def test_a_panel_has_the_mass_that_is_ranked():
    """Three periods of 6 x 6 mm."""
    made = case("gyroid")
    (text,) = sheet_panel(made, (9 * MM, 12 * MM))[1]
    grams = 1e3 * made.material.density * 3 * made.lattice.extruded
    assert text.startswith("9 x 12 mm, 6 mm thick, pressed along the print axis")
    assert f"rank counts {grams:.4g} g" in text


def test_settings_are_of_a_block_of_the_panel(tmp_path):
    layout, _ = sheet_block(case("tpmsd", "in_plane"), (60 * MM, 40 * MM))
    assert layout.shape.bounds == pytest.approx((0.0, 0.0, 60.0, 6.0))
    assert layout.depth == pytest.approx(40.0)
    for name, pattern in {"straight": "gyroid", "tpmsd": "tpmsd"}.items():
        wish = {"panel": (0.06, 0.04), "kind": "settings"}
        settings = export_case(case(name), tmp_path / f"{name}.3mf", **wish).notes[1]
        assert f"sparse infill {pattern}" in settings
        assert "direction 45 degrees" in settings
        assert ("PrusaSlicer reads" in settings) == (pattern == "gyroid")


@pytest.mark.parametrize(
    ("to", "wish", "words"),
    [
        ("a.stl", {}, "allowed with a panel"),
        ("a.stl", {"panel": ("1 mm", "9 mm")}, "smaller than a period; .* 6 x 6 mm"),
        ("a.stl", {"panel": ("2 m", "2 m")}, "at most 2,000"),
        ("a.svg", {"panel": ("50 mm", "50 mm")}, "no outline; allowed: .stl and .3mf"),
        ("a.3mf", {"panel": ("5 cm", "5 cm"), "kind": "settings"}, "lattice.slicer"),
    ],
)
def test_what_no_part_can_be_made_of_is_refused(tmp_path, to, wish, words):
    with pytest.raises(ExportError, match=words):
        export_case(case("gyroid"), tmp_path / to, **wish)
    assert not list(tmp_path.iterdir())


def test_a_block_is_printed_by_the_settings_of_its_slicer(tmp_path):
    lattice = dict(SHEETS["straight"], width=6 * MM, height=6 * MM, depth=6 * MM, perimeters=2)
    block = Case.of(lattice=lattice, loading={"direction": "in_plane"})
    layout, notes = sheet_block(block, None)
    width, height = block.lattice.outer_size
    assert layout.shape.bounds[2:] == pytest.approx([width / MM, height / MM])
    assert layout.depth == pytest.approx(block.lattice.depth / MM)
    assert f"{layout.grams:.4g} g" in notes[0]
    made = export_case(block, tmp_path / "a.3mf", kind="settings")
    assert "wall loops 2" in made.notes[1]
    with pytest.raises(ExportError, match="no panel"):
        sheet_block(block, (0.06, 0.04))
    with pytest.raises(ExportError, match="--kind settings"):
        sheet_panel(block, None)
