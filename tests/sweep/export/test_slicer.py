"""What slicers are asked for: relations of their patterns, and the fields that their code reads.

The readers: PrusaSlicer at commit 68e6f8ad, `src/libslic3r/Format/3mf.cpp` (line 88 and
`_3MF_Exporter::_add_model_config_file_to_archive` name the file and its fields;
`_3MF_Importer::_load_model_from_file` applies the metadata of an object by `set_deserialize`), and
OrcaSlicer at commit 00a815e5, `src/libslic3r/Format/bbs_3mf.cpp` (`BBS_MODEL_CONFIG_FILE`,
`_BBS_3MF_Importer::_handle_start_config_object`, `_handle_start_config_volume` and
`_handle_start_config_metadata`).
"""

import re
from math import pi
from xml.etree import ElementTree as Xml

import pytest
import shapely

from sweep.design.drawing import extent, pitch
from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.export.errors import ExportError
from sweep.export.slicer import NEAREST, PATTERNS, settings_of, share_of, slicer_files
from tests.support.designs.tables import lattice_with

T = 0.4  # mm
RISE = 0.75**0.5
# Boxes (mm) in which cells of each drawing are regular, of walls of this length (mm).
REGULAR = {
    ("square", None): ((40.0, 30.0), (8, 6), 5.0),
    ("diamond", None): ((40.0, 30.0), (4, 3), 10.0 * 0.5**0.5),
    ("triangle", None): ((5.0 * 4, 5.0 * 4 * RISE), (4, 4), 5.0),
    ("kagome", None): ((5.0 * 6.0, 5.0 * 4 * RISE), (3, 2), 5.0),
    ("hex", "pointy"): ((3.0 * 9 * RISE, 3.0 * 6.5), (4, 4), 3.0),
    ("hex", "flat"): ((3.0 * 6.5, 3.0 * 9 * RISE), (4, 4), 3.0),
}


def regular(kind, way, **changes):
    (width, height), (columns, rows), _ = REGULAR[kind, way]
    box = {"width": 1e-3 * width, "height": 1e-3 * height, "wall_thickness": 1e-3 * T}
    cells = {"cells_x": columns, "cells_y": rows}
    return lattice_with(kind=kind, orientation=way, **box | cells | changes)


def length_per_area(lattice):
    """Length of walls / area (1/mm) of an endless lattice of these cells: what one more column and
    one more row of two each add.
    """

    def length(columns, rows):
        drawn = lattice.geometry._replace(cells=(columns, rows), box=box(columns, rows))
        network = build_network(drawn)
        return shapely.length(shapely.multilinestrings(1e3 * network.points[network.walls]))

    def box(columns, rows):
        low, high = extent(lattice.kind, lattice.orientation, (columns, rows))
        return tuple(float(side) for side in (high - low) * scale)

    low, high = extent(lattice.kind, lattice.orientation, (lattice.cells_x, lattice.cells_y))
    scale = lattice.width / (high - low)[0]
    added = length(6, 6) - length(4, 6) - length(6, 4) + length(4, 4)
    return added / (4e6 * scale**2 * pitch(lattice.kind, lattice.orientation).prod())


@pytest.mark.parametrize(("kind", "way"), REGULAR)
def test_drawings_of_the_test_are_regular(kind, way):
    network = build_network(regular(kind, way).geometry)
    lines = shapely.linestrings(1e3 * network.points[network.walls])
    assert shapely.length(lines) == pytest.approx(REGULAR[kind, way][2], rel=1e-9)


EXPECTED = {
    ("square", None): ("grid", 0, 2 * T / 5.0, T),
    ("diamond", None): ("grid", 45, 2 * T / (10.0 * 0.5**0.5), T),
    ("triangle", None): ("triangles", 0, 2 * 3**0.5 * T / 5.0, T),
    ("kagome", None): ("stars", 0, 3**0.5 * T / 5.0, T),
    ("hex", "pointy"): ("honeycomb", 90, 2 * 0.75 * T / (2 * RISE * 3.0), 0.75 * T),
    ("hex", "flat"): ("honeycomb", 0, 2 * 0.75 * T / (2 * RISE * 3.0), 0.75 * T),
}


@pytest.mark.parametrize(("kind", "way"), REGULAR)
def test_shares_are_those_of_the_patterns(kind, way):
    """A grid has 2 s / pitch; triangles of side a 2 sqrt(3) s / a; kagome of edge e sqrt(3) s / e;
    honeycomb 2 s / flat to flat, with walls of 4 s / 3.
    """
    found = settings_of(regular(kind, way))
    pattern, angle, share, line = EXPECTED[kind, way]
    assert (found.pattern, found.angle) == (pattern, angle)
    assert (found.share, found.line) == pytest.approx((share, line), rel=1e-6)


@pytest.mark.parametrize(("kind", "way"), REGULAR)
def test_the_share_is_that_of_the_walls(kind, way):
    """Length of walls in a period x thickness / its area; a slicer does not count that of three
    layers of honeycomb one prints walls twice, which makes 4 / 3 of its lines.
    """
    lattice = regular(kind, way)
    counted = settings_of(lattice).share * (4 / 3 if kind == "hex" else 1.0)
    assert counted == pytest.approx(length_per_area(lattice) * T, rel=1e-6)


def test_width_of_a_line_is_that_of_its_mean():
    """The mean s is w - h (1 - pi / 4)."""
    keys = settings_of(regular("square", None, wall_thickness=0.407e-3)).prusa
    assert float(keys["infill_extrusion_width"]) == pytest.approx(0.45, abs=5e-4)
    assert float(keys["infill_extrusion_width"]) - 0.2 * (1 - pi / 4) == pytest.approx(
        0.407, abs=1e-4
    )


def test_walls_round_a_grid_are_a_perimeter():
    plain, outlined = regular("square", None), regular("square", None, perimeters=3)
    assert settings_of(plain).prusa["perimeters"] == "1"
    assert settings_of(outlined).prusa["perimeters"] == "3"
    assert settings_of(regular("kagome", None)).prusa["perimeters"] == "0"
    assert settings_of(outlined).perimeter == pytest.approx(0.4)


def test_prusa_reads_an_object_and_its_volume():
    settings = settings_of(regular("square", None))
    files = slicer_files(settings, "a44d", 12)
    root = Xml.fromstring(files["Metadata/Slic3r_PE_model.config"])
    assert root.tag == "config"
    (thing,) = root
    assert (thing.tag, thing.attrib) == ("object", {"id": "1", "instances_count": "1"})
    told = [node for node in thing if node.tag == "metadata"]
    assert {node.get("type") for node in told} == {"object"}
    keys = {node.get("key"): node.get("value") for node in told}
    width = f"{T + 0.2 * (1 - pi / 4):.4g}"
    assert keys == {
        "name": "a44d",
        "layer_height": "0.2",
        "fill_density": "16%",
        "fill_pattern": "grid",
        "fill_angle": "0",
        "infill_extrusion_width": width,
        "perimeters": "1",
        "perimeter_extrusion_width": width,
        "external_perimeter_extrusion_width": width,
        "top_solid_layers": "0",
        "bottom_solid_layers": "0",
        "solid_infill_below_area": "0",
        "infill_anchor": "0",
        "infill_anchor_max": "0",
    }
    (volume,) = thing.findall("volume")
    assert volume.attrib == {"firstid": "0", "lastid": "11"}
    about = {node.get("key"): node.get("value") for node in volume}
    assert about == {"name": "a44d", "volume_type": "ModelPart"}
    assert {node.get("type") for node in volume} == {"volume"}


def test_orca_and_bambu_read_an_object_and_its_part():
    files = slicer_files(settings_of(regular("kagome", None, perimeters=2)), "a44d", 12)
    root = Xml.fromstring(files["Metadata/model_settings.config"])
    (thing,) = root
    assert (root.tag, thing.tag, thing.attrib) == ("config", "object", {"id": "1"})
    keys = {node.get("key"): node.get("value") for node in thing.findall("metadata")}
    width = f"{T + 0.2 * (1 - pi / 4):.4g}"
    assert keys == {
        "name": "a44d",
        "layer_height": "0.2",
        "sparse_infill_density": f"{100 * 3**0.5 * T / 5.0:.4g}%",
        "sparse_infill_pattern": "tri-hexagon",
        "infill_direction": "0",
        "sparse_infill_line_width": width,
        "wall_loops": "2",
        "inner_wall_line_width": width,
        "outer_wall_line_width": width,
        "top_shell_layers": "0",
        "bottom_shell_layers": "0",
        "minimum_sparse_infill_area": "0",
        "infill_anchor": "0",
        "infill_anchor_max": "0",
    }
    (part,) = thing.findall("part")
    assert part.attrib == {"id": "1", "subtype": "normal_part"}


def test_no_profile_of_a_printer_is_invented():
    """A sparse `project_settings.config` makes Bambu Studio refuse the file."""
    assert {*slicer_files(settings_of(regular("square", None)), "a", 12)} == {
        "Metadata/Slic3r_PE_model.config",
        "Metadata/model_settings.config",
    }


@pytest.mark.parametrize("kind", sorted({*families()} - {kind for kind, _ in PATTERNS}))
def test_other_families_are_refused_with_the_nearest_if_any(kind):
    with pytest.raises(ExportError, match=f"no slicer draws {kind} cells; ") as refused:
        settings_of(lattice_with(kind=kind))
    hints = re.findall(r"; the nearest is (\w+)\.", str(refused.value))
    assert hints == ([NEAREST[kind]] if kind in NEAREST else [])


def test_the_nearest_has_a_pattern():
    assert {*NEAREST} <= {*families()}
    assert {*NEAREST.values()} <= {kind for kind, _ in PATTERNS}


REFUSED = [
    ({"grading": 2.0}, "lattice.grading = 2"),
    ({"solid_layers": 2}, "lattice.solid_layers = 2"),
    ({"width": 45e-3}, "lattice.width = 45 mm: cells are regular at 40 mm"),
]


@pytest.mark.parametrize(("changes", "why"), REFUSED)
def test_what_no_infill_can_be_is_refused(changes, why):
    with pytest.raises(ExportError, match=f"^{why}"):
        settings_of(regular("square", None, **changes))


def test_stretch_within_bounds_is_averaged():
    found = settings_of(regular("square", None, width=41e-3))
    assert found.share == pytest.approx(2 * T / (5.0 * 1.025**0.5), rel=1e-9)


def test_share_takes_a_pattern_a_thickness_and_a_period():
    assert share_of(PATTERNS["square", None], 0.45, 4.5) == pytest.approx(0.2)
    assert share_of(PATTERNS["hex", "flat"], 0.6, 4.5) == pytest.approx(0.2)


def laid(slicer, pattern, **changes):
    """A lattice of a slicer in a box of 25 mm."""
    box = {"width": 25e-3, "height": 25e-3, "infill": 0.2}
    return lattice_with(slicer=slicer, pattern=pattern, **box | changes)


def test_lattice_of_a_slicer_asks_for_its_own_settings():
    found = settings_of(laid("prusa", "honeycomb", fill_angle=0.5, perimeters=3))
    assert (
        found.prusa
        | {
            "fill_pattern": "honeycomb",
            "fill_density": "20%",
            "fill_angle": "28.65",
            "infill_extrusion_width": "0.45",
            "perimeters": "3",
            "perimeter_extrusion_width": "0.45",
        }
        == found.prusa
    )
    assert settings_of(laid("orca", "tri-hexagon")).prusa["fill_pattern"] == "stars"
    assert settings_of(laid("orca", "tri-hexagon")).orca["sparse_infill_pattern"] == "tri-hexagon"


def test_several_lines_are_asked_of_orca_alone():
    found = settings_of(laid("orca", "grid", fill_multiline=3))
    assert found.orca["fill_multiline"] == "3"
    assert "fill multiline 3" in found.by_hand
    assert list(slicer_files(found, "a", 12)) == ["Metadata/model_settings.config"]
    assert len(slicer_files(settings_of(laid("orca", "grid")), "a", 12)) == 2


def test_cura_reads_no_settings():
    with pytest.raises(ExportError, match=r"reads no settings from a \.3mf; allowed"):
        settings_of(laid("cura", "grid"))
