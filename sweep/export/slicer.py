"""A solid block with the infill that a slicer draws itself: pattern, per cent, width of a line.

A slicer's line is s = w - h (1 - pi/4) wide on average, with the extrusion width w and the layer
height h. At a share r of infill its patterns have (`libslic3r`, PrusaSlicer and its descendants)

    grid            pitch s / (r / 2)
    triangles       three families of lines, each at a distance of s / (r / 3)
    stars           the same, the third family shifted by half: kagome ("tri-hexagon" in Orca)
    honeycomb       flat to flat 2 s / r; of three layers one prints a wall twice, so that a wall is
                    4 s / 3 on average

Crossings are laid twice: blocks of these patterns with walls of a tenth of the pitch, sliced by
PrusaSlicer 2.5 at the pitches and directions of the lattice, were 0.1 to 6 % heavier than it.
"""

from __future__ import annotations

from math import degrees, pi
from typing import TYPE_CHECKING, NamedTuple
from xml.etree import ElementTree as Xml

from sweep.constants import TO_MM
from sweep.design.drawing import extent
from sweep.design.slicer.patterns import SLICERS
from sweep.export.errors import ExportError
from sweep.export.three_mf import OBJECT, xml_bytes

if TYPE_CHECKING:
    from sweep.config.kinds.cells import Cells
    from sweep.config.kinds.lattice import Lattice
    from sweep.config.kinds.sliced import Sliced

LAYER_HEIGHT = 0.2  # mm, where the lattice has none
STRETCHED = 0.05  # greatest deviation of the aspect ratio of a cell from a regular one
PRUSA = "Metadata/Slic3r_PE_model.config"
BAMBU = "Metadata/model_settings.config"
ORCA_NAMES = {"stars": "tri-hexagon"}
NEAREST = {"brick": "square", "circle": "hex", "reentrant": "hex"}


class Pattern(NamedTuple):
    """How a family of infill is printed.

    name : in PrusaSlicer. angle : `fill_angle`, degrees. lines : line widths / (share x period).
    thickness : of a wall, in line widths.
    """

    name: str
    angle: int
    lines: float
    thickness: float = 1.0


PATTERNS = {
    ("square", None): Pattern("grid", 0, 2.0),
    ("diamond", None): Pattern("grid", 45, 2.0),
    ("triangle", None): Pattern("triangles", 0, 3.0),
    ("kagome", None): Pattern("stars", 0, 3.0),
    ("hex", "pointy"): Pattern("honeycomb", 90, 2.0, 4.0 / 3.0),
    ("hex", "flat"): Pattern("honeycomb", 0, 2.0, 4.0 / 3.0),
}
PERIODS = {"square": 1.0, "diamond": 0.5**0.5, "triangle": 0.75**0.5, "kagome": 3.0**0.5}
PERIODS |= {"hex": 3.0**0.5}
"""Distance of the lines of one direction, of honeycomb from flat to flat, in units of a drawing."""


class Settings(NamedTuple):
    """What a slicer is asked for.

    angle : degrees; share : of infill, 0 to 1; line : mean width of a line, mm; lines : side by
    side in a wall of the infill.
    """

    pattern: str
    angle: float
    share: float
    line: float
    layer: float
    perimeters: int
    perimeter: float
    lines: int = 1

    @property
    def prusa(self) -> dict[str, str]:
        """Keys and values in PrusaSlicer."""
        width, outer = (_extruded(line, self.layer) for line in (self.line, self.perimeter))
        return {
            "layer_height": f"{self.layer:.4g}",
            "fill_density": f"{100 * self.share:.4g}%",
            "fill_pattern": self.pattern,
            "fill_angle": f"{self.angle:.4g}",
            "infill_extrusion_width": f"{width:.4g}",
            "perimeters": str(self.perimeters),
            "perimeter_extrusion_width": f"{outer:.4g}",
            "external_perimeter_extrusion_width": f"{outer:.4g}",
            "top_solid_layers": "0",
            "bottom_solid_layers": "0",
            "solid_infill_below_area": "0",
            "infill_anchor": "0",
            "infill_anchor_max": "0",
        }

    @property
    def orca(self) -> dict[str, str]:
        """The same in OrcaSlicer and Bambu Studio."""
        keys = {ORCA_KEYS[key]: value for key, value in self.prusa.items()}
        keys["sparse_infill_pattern"] = ORCA_NAMES.get(self.pattern, self.pattern)
        return keys | ({"fill_multiline": str(self.lines)} if self.lines > 1 else {})

    @property
    def by_hand(self) -> str:
        """The main settings as a person looks for them in OrcaSlicer or Bambu Studio."""
        keys = self.orca
        several = f", fill multiline {self.lines}" if self.lines > 1 else ""
        return (
            f"sparse infill {keys['sparse_infill_pattern']}, {keys['sparse_infill_density']}, "
            f"direction {keys['infill_direction']} degrees, line width "
            f"{keys['sparse_infill_line_width']} mm{several}; wall loops {keys['wall_loops']}, "
            f"width {keys['outer_wall_line_width']} mm; layer height {keys['layer_height']} mm; "
            "no top and bottom shell layers, no infill anchors"
        )


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


def settings_of(lattice: Lattice) -> Settings:
    """What to ask a slicer for so that it draws this lattice.

    A square grid has walls all round, which a slicer prints as a perimeter.
    """
    from sweep.config.kinds.cells import Cells
    from sweep.config.kinds.sliced import Sliced

    if isinstance(lattice, Sliced):
        return _own_settings(lattice)
    pattern = _pattern(lattice)
    assert isinstance(lattice, Cells)
    thickness, layer = TO_MM * lattice.wall_thickness, TO_MM * (lattice.layer_height or 0.0)
    around = TO_MM * (lattice.line_width or 0.0) if lattice.perimeters else thickness
    share = share_of(pattern, thickness, TO_MM * _period(lattice))
    if not share < 1.0:
        raise ExportError(f"lattice.wall_thickness fills the cells: no infill of {share:.0%}")
    count = lattice.perimeters or int(lattice.kind == "square")
    line = thickness / pattern.thickness
    layer = layer or LAYER_HEIGHT
    return Settings(pattern.name, pattern.angle, share, line, layer, count, around)


def _own_settings(lattice: Sliced) -> Settings:
    """The settings with which a lattice of a slicer is laid."""
    if lattice.slicer == "cura":
        raise ExportError(
            'lattice.slicer = "cura", which reads no settings from a .3mf; allowed with --kind '
            "settings: prusa and orca. crumple show says what to set in Cura; --kind lattice "
            "prints every design"
        )
    layer, line = TO_MM * lattice.layer_height, TO_MM * lattice.line
    return Settings(
        SLICERS[lattice.slicer][lattice.pattern],
        degrees(lattice.fill_angle),
        lattice.infill,
        line,
        layer,
        lattice.perimeters,
        line,
        lattice.fill_multiline,
    )


def share_of(pattern: Pattern, thickness: float, period: float) -> float:
    """Share of infill for walls of this thickness at this period, both in mm."""
    return pattern.lines * thickness / (pattern.thickness * period)


def slicer_files(settings: Settings, name: str, triangles: int) -> dict[str, bytes]:
    """The files of a 3MF in which slicers look for the settings of an object.

    PrusaSlicer cannot lay several lines side by side, and gets none of these settings then.
    """
    files = {BAMBU: _bambu_file(settings.orca, name)}
    if settings.lines == 1:
        files[PRUSA] = _prusa_file(settings.prusa, name, triangles)
    return files


def _pattern(lattice: Lattice) -> Pattern:
    """The pattern of a family of infill, if slicers have it."""
    from sweep.config.kinds.cells import Cells

    if isinstance(lattice, Cells):
        found = PATTERNS.get((lattice.kind, lattice.orientation))
        if found:
            _be_plain(lattice)
            return found
    allowed = ", ".join(dict.fromkeys(kind for kind, _ in PATTERNS))
    nearest = NEAREST.get(lattice.name)
    hint = f"; the nearest is {nearest}" if nearest else ""
    raise ExportError(
        f"no slicer draws {lattice.name} cells; allowed with --kind settings: {allowed}{hint}. "
        "--kind lattice prints every design"
    )


def _be_plain(lattice: Cells) -> None:
    """Refuse what the infill of a slicer cannot be: graded, capped, or of stretched cells."""
    stretch, width = _stretch(lattice), TO_MM * lattice.width / _stretch(lattice)
    regular = f"lattice.width = {TO_MM * lattice.width:.4g} mm: cells are regular at {width:.4g} mm"
    faults = {
        f"lattice.grading = {lattice.grading:g}": lattice.grading != 1.0,
        f"lattice.solid_layers = {lattice.solid_layers}": lattice.solid_layers > 0,
        regular: abs(stretch - 1.0) > STRETCHED,
    }
    if wrong := [words for words, fault in faults.items() if fault]:
        raise ExportError(
            f"{wrong[0]}; allowed with --kind settings: walls of one thickness, no caps and cells "
            f"regular within {STRETCHED:.0%}. --kind lattice prints every design"
        )


def _scales(lattice: Cells) -> tuple[float, float]:
    """Size of the box / that of the drawing in its own unit, in x and y."""
    low, high = extent(lattice.kind, lattice.orientation, (lattice.cells_x, lattice.cells_y))
    width, height = high - low
    return lattice.width / float(width), lattice.height / float(height)


def _stretch(lattice: Cells) -> float:
    across, up = _scales(lattice)
    return across / up


def _period(lattice: Cells) -> float:
    """Distance of neighbouring lines of one direction, m."""
    across, up = _scales(lattice)
    return PERIODS[lattice.kind] * (across * up) ** 0.5


def _extruded(line: float, layer: float) -> float:
    """Extrusion width of a line whose mean width is ``line``, mm."""
    return line + layer * (1.0 - pi / 4.0)


def _prusa_file(keys: dict[str, str], name: str, triangles: int) -> bytes:
    """Settings of the object, and its volume, of all triangles."""
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
