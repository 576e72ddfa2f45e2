"""3MF: a zip with the mesh as XML in mm, and the further files that slicers read.

Source of the format: 3MF Core Specification 1.3 (3mf.io).
"""

from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree as Xml
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from sweep.export.solid import Body
from sweep.version import __version__

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
MODEL = "3D/3dmodel.model"
OBJECT = "1"  # id of the only object
TYPES = {
    "rels": "application/vnd.openxmlformats-package.relationships+xml",
    "model": "application/vnd.ms-package.3dmanufacturing-3dmodel+xml",
    "config": "text/xml",
}


def write_3mf(path: Path, body: Body, name: str, beside: Mapping[str, bytes]) -> None:
    """Write a body as one object; equal bodies give equal bytes, as no time is stored.

    beside: name in the zip -> content, for further files.
    """
    files = {
        "[Content_Types].xml": _content_types(),
        "_rels/.rels": _relations(),
        MODEL: _model(body, name),
    }
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        for file, content in {**files, **beside}.items():
            archive.writestr(ZipInfo(file), content, ZIP_DEFLATED)


def xml_bytes(root: Xml.Element) -> bytes:
    """An XML document."""
    Xml.indent(root, " ")
    return bytes(Xml.tostring(root, "UTF-8", xml_declaration=True))


def _content_types() -> bytes:
    root = Xml.Element("Types", xmlns=f"{PACKAGE}/content-types")
    for ending, kind in TYPES.items():
        Xml.SubElement(root, "Default", Extension=ending, ContentType=kind)
    return xml_bytes(root)


def _relations() -> bytes:
    root = Xml.Element("Relationships", xmlns=f"{PACKAGE}/relationships")
    kind = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    Xml.SubElement(root, "Relationship", Target=f"/{MODEL}", Id="rel-1", Type=kind)
    return xml_bytes(root)


def _model(body: Body, name: str) -> bytes:
    root = Xml.Element("model", {"unit": "millimeter", "xml:lang": "en-US", "xmlns": CORE})
    for key, text in {"Title": name, "Application": f"Crumple-{__version__}"}.items():
        Xml.SubElement(root, "metadata", name=key).text = text
    resources = Xml.SubElement(root, "resources")
    item = Xml.SubElement(resources, "object", id=OBJECT, type="model", name=name)
    _mesh(Xml.SubElement(item, "mesh"), body)
    Xml.SubElement(Xml.SubElement(root, "build"), "item", objectid=OBJECT)
    return xml_bytes(root)


def _mesh(mesh: Xml.Element, body: Body) -> None:
    vertices = Xml.SubElement(mesh, "vertices")
    for point in body.points.tolist():
        x, y, z = (f"{value:.9g}" for value in point)
        Xml.SubElement(vertices, "vertex", x=x, y=y, z=z)
    triangles = Xml.SubElement(mesh, "triangles")
    for corners in body.triangles.tolist():
        v1, v2, v3 = map(str, corners)
        Xml.SubElement(triangles, "triangle", v1=v1, v2=v2, v3=v3)
