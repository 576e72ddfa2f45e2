"""SVG in mm: one path of closed rings, filled by the even-odd rule."""

from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml

from sweep.export.outline import Layout, rings
from sweep.export.three_mf import xml_bytes

FILL = "#2b4c6f"


def write_svg(path: Path, layout: Layout) -> None:
    """Write the outline of a layout; a unit of the drawing is a mm, and y points upwards."""
    _, _, width, height = layout.shape.bounds
    size = {"width": f"{width:.6g}mm", "height": f"{height:.6g}mm"}
    box = f"0 0 {width:.6g} {height:.6g}"
    root = Xml.Element("svg", {"xmlns": "http://www.w3.org/2000/svg", "viewBox": box} | size)
    Xml.SubElement(root, "title").text = layout.name
    d = " ".join(_ring(ring[:-1], height) for ring in rings(layout))
    Xml.SubElement(root, "path", {"d": d, "fill": FILL, "fill-rule": "evenodd"})
    path.write_bytes(xml_bytes(root))


def _ring(points: Any, height: float) -> str:
    """A ring of points (n, 2), mm, as a closed path; y of an SVG points downwards."""
    return "M" + " L".join(f"{x:.5f} {height - y:.5f}" for x, y in points) + " Z"
