"""A drawing is a lattice like the built-in ones, whatever file it comes from."""

import ezdxf
import pytest

from sweep.config.case import Case
from sweep.config.faults import ConfigError, MisfitError
from sweep.config.kinds.table import RefusedError
from sweep.config.load import case, load_config
from sweep.design.geometry import Drawing
from tests.support.converged import converged
from tests.support.designs import drawings
from tests.support.designs.drawings import GRID, SIDE, as_csv, as_dxf, as_json

CRUSH = {"mode": "displacement", "strain": 0.3, "platen": "glued"}
FORMATS = {
    "json": drawings.as_json,
    "csv": drawings.as_csv,
    "nodes.csv": drawings.as_nodes,
    "dxf": drawings.as_dxf,
    "data": drawings.as_lammps,
    "svg": drawings.as_svg,
}


def drawn(path, **lattice):
    """A crush of the drawing in a file."""
    table = {"kind": "drawn", "file": str(path), "nodes_per_wall": 2, **lattice}
    return case(lattice=table, material={"name": "cheetah"}, loading=CRUSH)


@pytest.fixture(scope="module")
def grid(tmp_path_factory):
    return drawn(as_csv(tmp_path_factory.mktemp("grid") / "grid.csv"))


def test_a_drawn_grid_is_the_built_in_one(grid):
    """Every column that does not name the design is equal; until densification both absorb as
    much.
    """
    lattice = {"cells": 3, "nodes_per_wall": 2, "width": "12.5 mm", "height": "12.5 mm"}
    built_in = case(lattice=lattice, material={"name": "cheetah"}, loading=CRUSH)
    one, other = (converged(design).summary for design in (grid, built_in))
    assert one["absorbed_energy_J"] == pytest.approx(0.37142, rel=1e-4)
    own = ("case_id", "lattice_kind", "slicer_settings", "energy_residual_J", "cpu_s")
    texts = {key: text for key, text in other.items() if key not in own and isinstance(text, str)}
    assert texts == {key: one[key] for key in texts}
    numbers = {key: other[key] for key in other if key not in (*own, *texts)}
    assert len(numbers) > 60
    assert {key: one[key] for key in numbers} == pytest.approx(numbers, rel=1e-5, nan_ok=True)


@pytest.mark.parametrize("name", FORMATS)
def test_a_drawing_is_the_same_case_in_every_format(tmp_path, grid, name):
    path = FORMATS[name](tmp_path / f"grid.{name}")
    unit = {"file_unit": "1 mm"} if name == "data" else {}
    assert drawn(path, **unit).case_id == grid.case_id
    assert drawn(path, **unit).lattice.name == f"grid.{name}"


def test_a_stored_case_needs_no_file_and_is_checked(grid):
    text = grid.to_json()
    again = Case.from_json(text)
    assert again == grid
    assert again.changed(lattice={"imperfection": 0.02}).case_id != grid.case_id
    thin = again.changed(lattice={"wall_thickness": 0.5e-3})
    assert thin.lattice.drawing == grid.lattice.drawing
    with pytest.raises(ValueError, match="walls between two of the joints"):
        Case.from_json(text.replace("[0,1]", "[0,99]"))
    with pytest.raises(ValueError, match="do not follow"):
        Case.from_json(text.replace('"width":0.0125', '"width":0.02'))
    with pytest.raises(ValueError, match="cannot be read"):
        grid.changed(lattice={"file": "another.svg"})


def test_a_file_says_what_the_config_does_not(tmp_path):
    """Thicknesses are shares of their mean by length, so that a config sets it."""
    lines = [((0, 0), (10, 0)), ((0, 5), (10, 5)), ((0, 0), (0, 5)), ((10, 0), (10, 5))]
    keys = {"depth_mm": 20, "subdivide": 5, "wall_thickness_mm": [2, 1, 1, 1]}
    table = {"kind": "drawn", "file": str(as_json(tmp_path / "a.json", lines, **keys))}
    made = case(lattice=table, loading=CRUSH).lattice
    assert (made.depth, made.nodes_per_wall) == (pytest.approx(0.02), 4)
    assert made.wall_thickness == pytest.approx(4 / 3 * 1e-3)
    assert (made.cells_x, made.cells_y) == (1, 1)
    table |= {"depth": "10 mm", "nodes_per_wall": 3}
    other = case(lattice=table | {"wall_thickness": "1 mm"}, loading=CRUSH).lattice
    assert (other.depth, other.nodes_per_wall) == (pytest.approx(0.01), 3)
    assert sorted(other.network.wall_thickness) == pytest.approx([0.75e-3] * 3 + [1.5e-3])
    light = case(lattice={**table, "mass": "0.2 g"}, loading=CRUSH)
    density = light.material.density
    assert density * 0.01 * light.lattice.network.printed_area == pytest.approx(0.2e-3, rel=1e-6)


def test_the_unit_is_that_of_the_file_or_of_the_config(tmp_path):
    path = as_dxf(tmp_path / "grid.dxf", units=0)
    with pytest.raises(ConfigError, match=r'file_unit is missing.*such as "1 mm", as it names non'):
        drawn(path)
    assert drawn(path, file_unit="2 mm").lattice.width == pytest.approx(2e-3 * SIDE)
    path = as_dxf(tmp_path / "inch.dxf", units=1)
    assert drawn(path, wall_thickness="20 mm").lattice.width == pytest.approx(25.4e-3 * SIDE)
    assert drawn(path, file_unit="1 mm").lattice.width == pytest.approx(1e-3 * SIDE)
    with pytest.raises(ConfigError, match=r"none, as grid.csv itself names the unit"):
        drawn(as_csv(tmp_path / "grid.csv"), file_unit="1 mm")


@pytest.mark.parametrize(
    ("lattice", "told"),
    [
        ({"file": None}, "lattice.file is missing; needed: the path of a drawing"),
        ({"wall_thickness": "3 mm"}, "below half the width of the widest cell, 2.083 mm"),
        ({"wall_thickness": "1e-9 mm"}, "at least .* mm, a millionth of the greatest"),
        ({"mass": "90 g"}, "between .* with these cells"),
        ({"width": "20 mm"}, r"allowed: 12\.5 mm, the size of the drawing"),
        ({"cells": 4}, "has no effect, as lattice.kind is"),
    ],
)
def test_what_does_not_fit_a_drawing_is_refused(tmp_path, lattice, told):
    table = {"kind": "drawn", "file": str(as_csv(tmp_path / "grid.csv"))} | lattice
    with pytest.raises(ConfigError, match=told):
        case(lattice={k: v for k, v in table.items() if v is not None}, loading=CRUSH)


def test_all_that_does_not_fit_a_drawing_is_told_at_once(grid, tmp_path):
    path = as_csv(tmp_path / "grid.csv")
    wrong = {"width": "3 cm", "height": "3 cm", "infill": "20 %", "sides": "periodic"}
    with pytest.raises(ConfigError) as refusal:
        drawn(path, **wrong)
    assert {fault.key for fault in refusal.value.faults} == {f"lattice.{key}" for key in wrong}
    drawn(path, width=f"{grid.lattice.width} m", sides="free")


def test_the_corner_of_a_sloppy_drawing_is_its_own(tmp_path):
    """If the lowest end overshoots, the walls begin above it, and at 0."""
    off = 5e-5 * SIDE
    lines = [
        ((x, y - off), (x, SIDE)) if y == 0.0 and x > 0.0 else ((x, y), e) for (x, y), e in GRID
    ]
    made = drawn(as_csv(tmp_path / "sloppy.csv", lines)).lattice
    assert made.counts == (16, 24)
    assert made.height == pytest.approx(1e-3 * SIDE, rel=1e-9)


def test_walls_of_a_drawing_in_python_are_checked():
    square = Drawing(((0.0, 0.0), (0.01, 0.0), (0.01, 0.01)), ((0, 1), (1, 2), (2, 0)))

    def made(drawing):
        return Case.of(lattice={"kind": "drawn", "drawing": drawing}, loading=dict(strain=0.1))

    whole = made(square)
    assert whole.lattice.name == "drawn"
    assert whole.lattice.thickest == pytest.approx(0.5 * 0.01 * (2 - 2**0.5))
    for walls in (((0, 1), (1, 2), (2, 3)), ((0, 1), (1, 1)), ((0, 1), (1, 0))):
        with pytest.raises(RefusedError, match="walls between two of the joints"):
            made(square._replace(walls=walls))
    with pytest.raises(RefusedError, match="least x and y are 0"):
        made(square._replace(joints=tuple((x + 0.01, y) for x, y in square.joints)))
    with pytest.raises(MisfitError, match="finite number"):
        Case.from_json(whole.to_json().replace("[0.01,0.01]", "[0.01,NaN]"))
    with pytest.raises(RefusedError, match="walls between"):
        made(Drawing((), ()))


def test_notes_tell_what_a_file_has_beside_lines(tmp_path):
    path = as_dxf(tmp_path / "grid.dxf")
    document = ezdxf.readfile(path)
    document.modelspace().add_text("A-A")
    document.saveas(path)
    config = load_config({"lattice": {"kind": "drawn", "file": str(path)}, "loading": CRUSH})
    assert config.notes == (f"{path}: left out: 1 x TEXT",)
