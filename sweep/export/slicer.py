"""Settings of a slicer in a 3MF, for a solid block that the slicer fills itself.

Crossings are laid twice: blocks of these patterns with walls of a tenth of the pitch, sliced by
PrusaSlicer 2.5 at the pitches and directions of the lattice, were 0.1 to 6 % heavier than the
lattice.
"""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING
from xml.etree import ElementTree as Xml

from sweep.constants import TO_MM
from sweep.design.slicer.patterns import PROGRAMS, SLICERS
from sweep.export.errors import ExportError
from sweep.export.three_mf import OBJECT, xml_bytes

if TYPE_CHECKING:
    from sweep.config.kinds.lattice import Lattice
    from sweep.config.slicer_settings import SlicerSettings

PRUSA = "Metadata/Slic3r_PE_model.config"
BAMBU = "Metadata/model_settings.config"
ORCA_KEYS = {
    "layer_height": "layer_height",
    "fill_density": "sparse_infill_density",
    "fill_pattern": "sparse_infill_pattern",
    "fill_angle": "infill_direction",
    "infill_extrusion_width": "sparse_infill_line_width",
    "perimeters": "wall_loops",
    "perimeter_extrusion_width": "inner_wall_line_width",
    "external_perimeter_extrusion_width": "outer_wall_line_width",
    "top_solid_layers": "top_shell_layers",
    "bottom_solid_layers": "bottom_shell_layers",
    "solid_infill_below_area": "minimum_sparse_infill_area",
    "infill_anchor": "infill_anchor",
    "infill_anchor_max": "infill_anchor_max",
}
"""Keys of PrusaSlicer -> keys of OrcaSlicer and Bambu Studio."""


def settings_of(lattice: Lattice) -> SlicerSettings:
    """The settings with which a slicer draws this lattice; raises `ExportError` with the reason if
    there are none.
    """
    from sweep.config.slicer_settings import slicer_settings, unlike

    settings = slicer_settings(lattice)
    if settings is None:
        raise ExportError(f"{unlike(lattice)}. --kind lattice prints every design")
    if not PROGRAMS[settings.slicer].reads:
        allowed = " and ".join(name for name, program in PROGRAMS.items() if program.reads)
        raise ExportError(
            f'lattice.slicer = "{settings.slicer}", which reads no settings from a .3mf; allowed '
            f"with --kind settings: {allowed}. crumple show says what to set in "
            f"{PROGRAMS[settings.slicer].title}; --kind lattice prints every design"
        )
    return settings


def prusa_keys(settings: SlicerSettings) -> dict[str, str]:
    """Keys and values of PrusaSlicer."""
    infill, outer = (
        f"{TO_MM * width:.4g}" for width in (settings.line_width, settings.perimeter_width)
    )
    return {
        "layer_height": f"{TO_MM * settings.layer_height:.4g}",
        "fill_density": f"{100 * settings.infill:.4g}%",
        "fill_pattern": SLICERS[settings.slicer].get(settings.pattern, settings.pattern),
        "fill_angle": f"{degrees(settings.fill_angle):.4g}",
        "infill_extrusion_width": infill,
        "perimeters": str(settings.perimeters),
        "perimeter_extrusion_width": outer,
        "external_perimeter_extrusion_width": outer,
        "top_solid_layers": str(settings.solid_layers),
        "bottom_solid_layers": str(settings.solid_layers),
        "solid_infill_below_area": "0",
        "infill_anchor": "0",
        "infill_anchor_max": "0",
    }


def orca_keys(settings: SlicerSettings) -> dict[str, str]:
    """Keys and values of OrcaSlicer and Bambu Studio."""
    prusa = prusa_keys(settings)
    own_names = {name: own for own, name in SLICERS["orca"].items()}
    keys = {ORCA_KEYS[key]: value for key, value in prusa.items()}
    keys["sparse_infill_pattern"] = own_names.get(prusa["fill_pattern"], settings.pattern)
    lines = settings.fill_multiline
    return keys | ({"fill_multiline": str(lines)} if lines > 1 else {})


def by_hand(settings: SlicerSettings) -> str:
    """The main settings by their names in OrcaSlicer or Bambu Studio."""
    keys, lines = orca_keys(settings), settings.fill_multiline
    several = f", fill multiline {lines}" if lines > 1 else ""
    return (
        f"sparse infill {keys['sparse_infill_pattern']}, {keys['sparse_infill_density']}, "
        f"direction {keys['infill_direction']} degrees, line width "
        f"{keys['sparse_infill_line_width']} mm{several}; wall loops {keys['wall_loops']}, "
        f"width {keys['outer_wall_line_width']} mm; layer height {keys['layer_height']} mm; "
        f"{settings.solid_layers or 'no'} top and bottom shell layers, no infill anchors"
    )


def prusa_reads(settings: SlicerSettings) -> bool:
    """Whether PrusaSlicer supports these settings: it has no walls of several lines, no TPMS-D."""
    prusa = PROGRAMS["prusa"]
    draws = prusa_keys(settings)["fill_pattern"] in (*prusa.patterns, *prusa.sheets)
    return draws and settings.fill_multiline <= prusa.lines


def slicer_files(settings: SlicerSettings, name: str, triangles: int) -> dict[str, bytes]:
    """The files of a 3MF in which slicers look for the settings of an object."""
    files = {BAMBU: _bambu_file(orca_keys(settings), name)}
    if prusa_reads(settings):
        files[PRUSA] = _prusa_file(prusa_keys(settings), name, triangles)
    return files


def _prusa_file(keys: dict[str, str], name: str, triangles: int) -> bytes:
    """Settings of the object and of its volume, which has all triangles."""
    root = Xml.Element("config")
    item = Xml.SubElement(root, "object", id=OBJECT, instances_count="1")
    for key, value in {"name": name, **keys}.items():
        Xml.SubElement(item, "metadata", type="object", key=key, value=value)
    volume = Xml.SubElement(item, "volume", firstid="0", lastid=str(triangles - 1))
    for key, value in {"name": name, "volume_type": "ModelPart"}.items():
        Xml.SubElement(volume, "metadata", type="volume", key=key, value=value)
    return xml_bytes(root)


def _bambu_file(keys: dict[str, str], name: str) -> bytes:
    """Settings of the object, and its part."""
    root = Xml.Element("config")
    item = Xml.SubElement(root, "object", id=OBJECT)
    for key, value in {"name": name, **keys}.items():
        Xml.SubElement(item, "metadata", key=key, value=value)
    part = Xml.SubElement(item, "part", id=OBJECT, subtype="normal_part")
    Xml.SubElement(part, "metadata", key="name", value=name)
    return xml_bytes(root)
