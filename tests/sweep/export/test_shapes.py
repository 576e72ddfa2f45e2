"""Shapes for ParaView, as VTK reads them."""

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

from sweep.export.shapes import LINE, QUAD, write_shapes
from tests.support.results.specimens import squeezed_cell, tube

HEIGHTS = (10.0, 7.0, 4.0)


def written(tmp_path, frames):
    path = tmp_path / "crush.vtkhdf"
    write_shapes(path, frames)
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    return reader


def grid_of(reader, k):
    """Shape number ``k``: points, corners of its cells, and arrays by name."""
    reader.SetStep(k)
    reader.Update()
    grid = reader.GetOutput()
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    arrays = {
        data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
        for data in (grid.GetPointData(), grid.GetCellData(), grid.GetFieldData())
        for i in range(data.GetNumberOfArrays())
    }
    kinds = {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return kinds, points, cells.reshape(grid.GetNumberOfCells(), -1), arrays


@pytest.mark.parametrize("k", range(3))
def test_lines_are_the_elements_in_mm(tmp_path, k):
    reader, height = written(tmp_path, squeezed_cell(heights=HEIGHTS)), HEIGHTS[k]
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    assert times == pytest.approx((0.0, 0.01, 0.02))
    kinds, points, cells, arrays = grid_of(reader, k)
    np.testing.assert_allclose(points, [[0, 0, 0], [10, 0, 0], [10, height, 0], [0, height, 0]])
    assert kinds == {LINE}
    assert cells.tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    moved = [0, 0, height - 10, height - 10]
    np.testing.assert_allclose(arrays["displacement_mm"][:, 1], moved, atol=1e-12)
    np.testing.assert_allclose(arrays["wall_thickness_mm"], 1.0)
    shorter = height / 10 - 1
    np.testing.assert_allclose(arrays["element_strain"], [0, shorter, 0, shorter], atol=1e-12)
    np.testing.assert_allclose(arrays["strain"], [-shorter], atol=1e-12)


@pytest.mark.parametrize("k", range(3))
def test_quads_are_those_of_plates_in_mm(tmp_path, k):
    frames = tube()
    kinds, points, cells, arrays = grid_of(written(tmp_path, frames), k)
    np.testing.assert_allclose(points, 1e3 * frames["position_m"][k], atol=1e-9)
    assert kinds == {QUAD}
    assert cells.tolist() == frames["quads"].tolist()
    moved = 1e3 * (frames["position_m"][k] - frames["position_m"][0])
    np.testing.assert_allclose(arrays["displacement_mm"], moved, atol=1e-9)
    np.testing.assert_allclose(arrays["wall_thickness_mm"], 0.1)
    np.testing.assert_allclose(arrays["area_strain"], -0.1 * k, atol=1e-9)
