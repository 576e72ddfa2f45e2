"""Every format through one door: the right file or a sentence, never half of one."""

import re
from pathlib import Path
from xml.etree import ElementTree as Xml
from zipfile import ZipFile

import h5py
import pandas as pd
import pytest
import trimesh
from PIL import Image

import crumple
from sweep.config.case import Case
from sweep.config.grid import Config
from sweep.config.units import quantity
from sweep.export import export as module
from sweep.export.errors import ExportError
from sweep.export.export import WRITERS, export_case
from sweep.running.searching.design_space import DesignSpace
from tests.support.command import crumple as call
from tests.support.results.exported import grid, results
from tests.support.results.specimens import summary, write

CASE = grid()


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    other = Case.of(lattice=dict(kind="reentrant", depth=20e-3))
    return results(tmp_path_factory.mktemp("stored") / "trial.h5", CASE, other)


def exported(file, path, **wish):
    found = export_case(file, path, CASE.case_id, **wish)
    assert found.file == Path(path)
    return found


def extents(file):
    with ZipFile(file) as archive:
        model = Xml.fromstring(archive.read("3D/3dmodel.model"))
    points = [[float(v.get(k)) for k in "xyz"] for v in model.iter() if v.tag.endswith("vertex")]
    return trimesh.PointCloud(points).extents


def test_stl_weighs_what_the_ranking_says(file, tmp_path):
    found = exported(file, tmp_path / "part.stl")
    mesh = trimesh.load_mesh(tmp_path / "part.stl")
    assert mesh.is_watertight
    grams = 1e-3 * mesh.volume * 1e-3 * CASE.material.density
    (row,) = crumple.read_summary(file).query(f"case_id == '{CASE.case_id}'")["mass_g"]
    assert grams == pytest.approx(row, rel=1e-5)
    assert found.notes[0] == f"13.3 x 13.3 mm, 12 mm deep: {row:.4g} g"


def test_case_is_exported_before_it_runs(file, tmp_path):
    crumple.export_case(CASE, tmp_path / "a.stl")
    exported(file, tmp_path / "b.stl")
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "b.stl").read_bytes()
    for ending in (".csv", ".vtkhdf", ".gif"):
        with pytest.raises(crumple.ExportError, match=r"alone has no .*; allowed: a results"):
            export_case(CASE, tmp_path / f"a{ending}")
    assert {path.name for path in tmp_path.iterdir()} == {"a.stl", "b.stl"}


DIAMOND = {"kind": "diamond", "cells_x": 2, "cells_y": 2, "wall_thickness": 1.6e-3}


@pytest.mark.parametrize(
    ("lattice", "sides", "size", "counted"),
    [
        (
            {},
            ("100 mm", 0.05),
            "7 side by side, each 4 specimens of 12 mm deep: 95.5 x",
            "these 28",
        ),
        ({}, ("30 mm", "12 mm"), "2 side by side, each 12 mm deep: 27 x", "these 2 specimens, "),
        ({}, ("13 mm", "12 mm"), "13.3 x 13.3 mm, 12 mm deep: ", "this specimen is what rank"),
        # The tips of a diamond are farther out than half a wall: 4 specimens, (2^0.5 - 1) t each.
        (DIAMOND, (0.058, 0.012), "4 side by side", ".* make them 2.7 mm wider$"),
    ],
)
def test_a_panel_is_described(tmp_path, lattice, sides, size, counted):
    case = Case.of(lattice=lattice) if lattice else CASE
    first, second, _ = export_case(case, tmp_path / "a.stl", panel=sides).notes
    assert first.startswith(size)
    assert re.match(counted, second)


def test_panel_of_what_is_pressed_along_its_cells_shows_its_drawing(tmp_path):
    """Plans of 13.3 x 13.3 mm, 7 x 4 of them: as high as one, apart in both directions."""
    case = Case.of(loading=dict(direction="out_of_plane"))
    size, *_ = export_case(case, tmp_path / "panel.stl", panel=("100 mm", 0.05)).notes
    body = trimesh.load_mesh(tmp_path / "panel.stl")
    side, height = 1e3 * case.lattice.outer_size[0], 1e3 * case.lattice.depth
    extents = [count * (side + 0.4) - 0.4 for count in (7, 4)]
    assert body.extents == pytest.approx([*extents, height], abs=1e-3)
    assert len(body.split()) == 28
    assert f"each 4 specimens of {side:.4g} mm" in size
    plan = {"direction": "out_of_plane", "outer_width_m": 1e-3 * side, "depth_m": 1e-3 * side}
    (row,) = crumple.rank(summary(plan), panel=("100 mm", "50 mm")).to_dict("records")
    assert row["panel_specimens"] == 28
    assert [1e3 * row["panel_width_m"], 1e3 * row["panel_depth_m"]] == pytest.approx(extents)


@pytest.mark.parametrize("sides", [("100 mm", "50 mm"), ("4 in", "2 in"), ("30 mm", "17 mm")])
def test_a_panel_is_what_is_ranked_and_searched(file, tmp_path, sides):
    """Number, true size and mass in the file agree with the ranking and the search."""
    exported(file, tmp_path / "panel.stl", panel=sides)
    mesh = trimesh.load_mesh(tmp_path / "panel.stl")
    (row,) = crumple.rank(file, panel=sides).query(f"case_id == '{CASE.case_id}'").to_records()
    across = round((row["panel_width_m"] + 0.4e-3) / 13.7e-3)
    assert mesh.body_count == across
    true = [1e3 * row["panel_width_m"], 13.3, 1e3 * row["panel_depth_m"]]
    assert mesh.extents == pytest.approx(true, abs=1e-3)
    grams = 1e-6 * mesh.volume * CASE.material.density
    assert grams == pytest.approx(row["panel_mass_g"], rel=1e-5)
    lengths = tuple(quantity(side, "m") for side in sides)
    space = DesignSpace(Config("any"), budget=1.0, panel=lengths)
    assert 1e3 * space.weight(CASE) == pytest.approx(row["panel_mass_g"], rel=1e-9)


def test_lattice_in_3mf_asks_for_full_infill_in_words_only(file, tmp_path):
    notes = exported(file, tmp_path / "part.3mf").notes
    assert exported(file, tmp_path / "part.stl").notes == notes
    names = ZipFile(tmp_path / "part.3mf").namelist()
    assert not [name for name in names if name.startswith("Metadata")]
    assert notes[1] == "print it with 100 % infill"


def test_block_in_3mf_has_settings(file, tmp_path):
    found = exported(file, tmp_path / "block.3mf", kind="settings", panel=("30 mm", "12 mm"))
    with ZipFile(tmp_path / "block.3mf") as archive:
        config = Xml.fromstring(archive.read("Metadata/Slic3r_PE_model.config"))
    share = 2 * 0.8 / (12.5 / 3)
    keys = {node.get("key"): node.get("value") for node in config.iter("metadata")}
    assert keys["fill_density"] == f"{100 * share:.4g}%"
    assert int(config.find("object/volume").get("lastid")) == 2 * 12 - 1
    assert extents(tmp_path / "block.3mf") == pytest.approx([2 * 13.7 - 0.4, 13.3, 12.0])
    assert "sparse infill grid, 38.4%, direction 0 degrees" in found.notes[2]
    assert found.notes[0].startswith("2 side by side")


@pytest.mark.parametrize(("name", "kind"), [("walls.stl", None), ("block.3mf", "settings")])
def test_a_lateral_pattern_stands_on_its_layers(tmp_path, name, kind):
    """Its height is z, and its lines run along y, which is its depth."""
    box = dict(width=24e-3, height=12e-3, depth=18e-3)
    case = Case.of(lattice=dict(slicer="orca", pattern="lateral-lattice", infill=0.15, **box))
    notes = export_case(case, tmp_path / name, kind=kind).notes
    width, height = (1e3 * side for side in case.lattice.outer_size)
    file = tmp_path / name
    seen = extents(file) if kind else trimesh.load_mesh(file).extents
    assert seen == pytest.approx([width, 18.0, height], abs=1e-3)
    if kind:
        assert "lateral-lattice, 15%, direction 0 degrees" in notes[1]
        assert "4 top and bottom shell layers" in notes[1]
        assert "perimeters in front and behind" in notes[2]


def test_curves_and_shapes(file, tmp_path):
    exported(file, tmp_path / "c.csv")
    assert len(pd.read_csv(tmp_path / "c.csv")) == 41
    exported(file, tmp_path / "crush.vtkhdf")
    with h5py.File(tmp_path / "crush.vtkhdf") as shapes:
        assert shapes["VTKHDF/Steps"].attrs["NSteps"] == 8
    exported(file, tmp_path / "crush.gif")
    with Image.open(tmp_path / "crush.gif") as moving:
        assert moving.n_frames == 8


@pytest.mark.parametrize("name", ["part.svg", "part.DXF"])
def test_folder_is_made_and_a_file_replaced(file, tmp_path, name):
    path = tmp_path / "new" / name
    for _ in range(2):
        exported(file, path)
        assert [entry.name for entry in path.parent.iterdir()] == [name]


REFUSED = [
    ("part.xyz", {}, r"part.xyz: .xyz is unknown; allowed: .stl, .3mf, .svg, .dxf, .csv, .vtkhdf"),
    ("part", {}, "part: has no ending; allowed: .stl"),
    ("c.csv", {"panel": (0.1, 0.05)}, "c.csv shows no print; allowed .*: .stl"),
    ("part.stl", {"kind": "settings"}, "part.stl has one kind only; allowed .*: .3mf"),
    ("part.3mf", {"kind": "solid"}, 'kind "solid"; allowed: lattice, settings'),
    ("part.stl", {"panel": (0.1,)}, "panel 0.1; allowed: two lengths"),
    ("part.stl", {"panel": (0.1, 0.0)}, "panel 0.1, 0.0; allowed: .* above zero"),
    ("new/deep/part.stl", {"panel": ("5 mm", "5 mm")}, "panel of 5 mm .* specimen of 13.3 mm"),
]


@pytest.mark.parametrize(("name", "wish", "why"), REFUSED)
def test_refusals_leave_nothing(file, tmp_path, name, wish, why):
    with pytest.raises(ExportError, match=why):
        exported(file, tmp_path / name, **wish)
    assert list(tmp_path.iterdir()) == []


def test_unknown_case_is_named(file, tmp_path):
    with pytest.raises(ExportError, match=r"trial.h5 has 2 cases; needed: case_id, of [0-9a-f]+, "):
        export_case(file, tmp_path / "part.stl")
    with pytest.raises(ExportError, match=r'trial.h5 holds no case "zz"'):
        export_case(file, tmp_path / "part.stl", "zz")


def test_case_that_failed_has_no_curves_and_says_why(tmp_path):
    row = {"case_id": "ab", "status": "stopped", "message": "no equilibrium"}
    file = write(tmp_path / "trial.h5", summary(row))
    for ending, what in {".csv": "curves", ".vtkhdf": "shapes", ".gif": "shapes"}.items():
        with pytest.raises(ExportError, match=f"case ab has no {what}: no equilibrium"):
            export_case(file, tmp_path / f"a{ending}", "ab")


def test_failure_leaves_the_older_file(file, tmp_path, monkeypatch):
    path = tmp_path / "part.svg"
    path.write_text("older")

    def fail(beside, *_):
        beside.write_text("half")
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(module.WRITERS, ".svg", fail)
    monkeypatch.setitem(module.PRINTS, ".svg", fail)
    with pytest.raises(OSError, match="No space"):
        exported(file, path)
    assert [found.read_text() for found in tmp_path.iterdir()] == ["older"]


def test_every_format_is_in_the_help(capsys):
    _, told, _ = call(capsys, "export", "--help")
    assert all(ending in told for ending in WRITERS)
