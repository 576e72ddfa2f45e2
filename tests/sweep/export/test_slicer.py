"""The settings for slicers: the fields that their code reads.

The readers: PrusaSlicer at commit 68e6f8ad, `src/libslic3r/Format/3mf.cpp` (line 88 and
`_3MF_Exporter::_add_model_config_file_to_archive` name the file and its fields;
`_3MF_Importer::_load_model_from_file` applies the metadata of an object by `set_deserialize`), and
OrcaSlicer at commit 00a815e5, `src/libslic3r/Format/bbs_3mf.cpp` (`BBS_MODEL_CONFIG_FILE`,
`_BBS_3MF_Importer::_handle_start_config_object`, `_handle_start_config_volume` and
`_handle_start_config_metadata`).
"""

from math import pi
from xml.etree import ElementTree as Xml

from sweep.export.slicer import by_hand, orca_keys, prusa_keys, settings_of, slicer_files
from tests.support.designs.tables import lattice_with

BOXES = {"square": ((40.0, 30.0), (8, 6)), "kagome": ((30.0, 20.0 * 0.75**0.5), (3, 2))}
"""Sizes (mm) and cells with walls of 5 mm."""


def lattice(kind, **changes):
    (width, height), (columns, rows) = BOXES[kind]
    box = {"width": 1e-3 * width, "height": 1e-3 * height, "wall_thickness": 0.4e-3}
    return lattice_with(kind=kind, cells_x=columns, cells_y=rows, **box | changes)


WIDTH = f"{0.4 + 0.2 * (1 - pi / 4):.4g}"


def values(nodes):
    return {node.get("key"): node.get("value") for node in nodes}


def test_prusa_reads_an_object_and_its_volume():
    """There are no other files: a sparse `project_settings.config` makes Bambu Studio refuse."""
    files = slicer_files(settings_of(lattice("square")), "a44d", 12)
    assert {*files} == {"Metadata/Slic3r_PE_model.config", "Metadata/model_settings.config"}
    root = Xml.fromstring(files["Metadata/Slic3r_PE_model.config"])
    (thing,) = root
    assert (root.tag, thing.tag) == ("config", "object")
    assert thing.attrib == {"id": "1", "instances_count": "1"}
    told = thing.findall("metadata")
    assert {node.get("type") for node in told} == {"object"}
    assert values(told) == {
        "name": "a44d",
        "layer_height": "0.2",
        "fill_density": "16%",
        "fill_pattern": "grid",
        "fill_angle": "0",
        "infill_extrusion_width": WIDTH,
        "perimeters": "1",
        "perimeter_extrusion_width": WIDTH,
        "external_perimeter_extrusion_width": WIDTH,
        "top_solid_layers": "0",
        "bottom_solid_layers": "0",
        "solid_infill_below_area": "0",
        "infill_anchor": "0",
        "infill_anchor_max": "0",
    }
    (volume,) = thing.findall("volume")
    assert volume.attrib == {"firstid": "0", "lastid": "11"}
    assert values(volume) == {"name": "a44d", "volume_type": "ModelPart"}
    assert {node.get("type") for node in volume} == {"volume"}


def test_orca_and_bambu_read_an_object_and_its_part():
    files = slicer_files(settings_of(lattice("kagome", perimeters=2)), "a44d", 12)
    root = Xml.fromstring(files["Metadata/model_settings.config"])
    (thing,) = root
    assert (root.tag, thing.tag, thing.attrib) == ("config", "object", {"id": "1"})
    assert values(thing.findall("metadata")) == {
        "name": "a44d",
        "layer_height": "0.2",
        "sparse_infill_density": f"{100 * 3**0.5 * 0.4 / 5.0:.4g}%",
        "sparse_infill_pattern": "tri-hexagon",
        "infill_direction": "0",
        "sparse_infill_line_width": WIDTH,
        "wall_loops": "2",
        "inner_wall_line_width": WIDTH,
        "outer_wall_line_width": WIDTH,
        "top_shell_layers": "0",
        "bottom_shell_layers": "0",
        "minimum_sparse_infill_area": "0",
        "infill_anchor": "0",
        "infill_anchor_max": "0",
    }
    (part,) = thing.findall("part")
    assert part.attrib == {"id": "1", "subtype": "normal_part"}


def laid(slicer, pattern, **changes):
    box = {"width": 25e-3, "height": 25e-3, "infill": 0.2}
    return lattice_with(slicer=slicer, pattern=pattern, **box | changes)


def test_lattice_of_a_slicer_asks_for_its_own_settings():
    own = {
        "fill_pattern": "honeycomb",
        "fill_density": "20%",
        "fill_angle": "28.65",
        "infill_extrusion_width": "0.45",
        "perimeters": "3",
        "perimeter_extrusion_width": "0.45",
    }
    settings = settings_of(laid("prusa", "honeycomb", fill_angle=0.5, perimeters=3))
    assert own.items() <= prusa_keys(settings).items()
    stars = settings_of(laid("orca", "tri-hexagon"))
    assert prusa_keys(stars)["fill_pattern"] == "stars"
    assert orca_keys(stars)["sparse_infill_pattern"] == "tri-hexagon"


def test_several_lines_are_asked_of_orca_alone():
    found = settings_of(laid("orca", "grid", fill_multiline=3))
    assert orca_keys(found)["fill_multiline"] == "3"
    assert "fill multiline 3" in by_hand(found)
    assert list(slicer_files(found, "a", 12)) == ["Metadata/model_settings.config"]
    assert len(slicer_files(settings_of(laid("orca", "grid")), "a", 12)) == 2
