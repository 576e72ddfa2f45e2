"""Shapes for ParaView, as meshio reads them."""

from xml.etree import ElementTree as Xml

import meshio
import numpy as np
import pytest

from sweep.export.shapes import write_shapes
from tests.support.results.specimens import squeezed_cell, tube

HEIGHTS = (10.0, 7.0, 4.0)


@pytest.fixture
def folder(tmp_path):
    write_shapes(tmp_path, "crush", squeezed_cell(heights=HEIGHTS))
    return tmp_path


def test_a_file_for_each_shape_and_a_list_of_them(folder):
    names = {path.name for path in folder.iterdir()}
    assert names == {"crush.pvd", *(f"crush_000{k}.vtu" for k in range(3))}
    sets = Xml.parse(folder / "crush.pvd").getroot().findall("Collection/DataSet")
    assert [node.get("file") for node in sets] == [f"crush_000{k}.vtu" for k in range(3)]
    assert [float(node.get("timestep")) for node in sets] == [0.0, 0.01, 0.02]


@pytest.mark.parametrize("k", range(3))
def test_lines_are_the_elements_in_mm(folder, k):
    mesh = meshio.read(folder / f"crush_000{k}.vtu")
    height = HEIGHTS[k]
    corners = [[0, 0, 0], [10, 0, 0], [10, height, 0], [0, height, 0]]
    np.testing.assert_allclose(mesh.points, corners, rtol=1e-7)
    assert mesh.cells_dict["line"].tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    moved = mesh.point_data["displacement_mm"]
    np.testing.assert_allclose(moved[:, 1], [0, 0, height - 10, height - 10], atol=1e-6)
    (thickness,), (strain,) = (mesh.cell_data[n] for n in ("wall_thickness_mm", "element_strain"))
    np.testing.assert_allclose(thickness, 1.0)
    np.testing.assert_allclose(strain, [0, height / 10 - 1, 0, height / 10 - 1], atol=1e-7)
    np.testing.assert_allclose(mesh.field_data["strain"], [1 - height / 10], atol=1e-7)


@pytest.mark.parametrize("k", range(3))
def test_quads_are_those_of_plates_in_mm(tmp_path, k):
    frames = tube()
    write_shapes(tmp_path, "tube", frames)
    mesh = meshio.read(tmp_path / f"tube_000{k}.vtu")
    np.testing.assert_allclose(mesh.points, 1e3 * frames["position_m"][k], atol=1e-9)
    assert mesh.cells_dict["quad"].tolist() == frames["quads"].tolist()
    moved = 1e3 * (frames["position_m"][k] - frames["position_m"][0])
    np.testing.assert_allclose(mesh.point_data["displacement_mm"], moved, atol=1e-9)
    (thickness,), (strain,) = (mesh.cell_data[n] for n in ("wall_thickness_mm", "area_strain"))
    np.testing.assert_allclose(thickness, 0.1)
    np.testing.assert_allclose(strain, -0.1 * k, atol=1e-9)
