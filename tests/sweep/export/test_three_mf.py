"""3MF: the package, and the mesh in it."""

from xml.etree import ElementTree as Xml
from zipfile import ZipFile

import numpy as np
import pytest
import trimesh

import crumple
from sweep.export.solid import Body
from sweep.export.three_mf import write_3mf

CUBE = trimesh.creation.box((10.0, 20.0, 30.0))
NAMES = {"m": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}


@pytest.fixture
def archive(tmp_path):
    path = tmp_path / "part.3mf"
    body = Body(np.array(CUBE.vertices), np.array(CUBE.faces))
    write_3mf(path, body, "a & b", {"Metadata/more.config": b"<x/>"})
    with ZipFile(path) as archive:
        yield archive


def test_package_has_the_parts_of_the_specification(archive):
    """3MF Core Specification, chapter 2: content types, a relationship to the model, the model."""
    names = {"[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model", "Metadata/more.config"}
    assert {*archive.namelist()} == names
    types = Xml.fromstring(archive.read("[Content_Types].xml"))
    endings = {node.get("Extension"): node.get("ContentType") for node in types}
    assert endings["model"] == "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"
    (relation,) = Xml.fromstring(archive.read("_rels/.rels"))
    assert relation.get("Target") == "/3D/3dmodel.model"
    assert relation.get("Type") == "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    assert archive.read("Metadata/more.config") == b"<x/>"


def test_mesh_is_the_body_in_mm(archive):
    model = Xml.fromstring(archive.read("3D/3dmodel.model"))
    assert model.get("unit") == "millimeter"

    def rows(tag, keys, number):
        return [[number(node.get(k)) for k in keys] for node in model.iterfind(tag, NAMES)]

    sides = rows(".//m:triangle", ("v1", "v2", "v3"), int)
    mesh = trimesh.Trimesh(rows(".//m:vertex", "xyz", float), sides, process=False)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(6000.0)


def test_object_is_built_and_named(archive):
    model = Xml.fromstring(archive.read("3D/3dmodel.model"))
    item, thing = model.find("m:build/m:item", NAMES), model.find(".//m:object", NAMES)
    assert item.get("objectid") == thing.get("id")
    assert (thing.get("name"), thing.get("type")) == ("a & b", "model")
    told = {node.get("name"): node.text for node in model.iterfind("m:metadata", NAMES)}
    assert told == {"Title": "a & b", "Application": f"Crumple-{crumple.__version__}"}
