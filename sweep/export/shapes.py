"""VTK: the shapes of a crush as a series for ParaView, one .vtu file per stored shape.

The elements of the walls are lines, those of plates quads. Points have their displacement, in mm
as all lengths; lines have their wall thickness and the strain of their chord, quads that of their
area. `NAME.pvd` lists the files with their times.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as Xml

import numpy as np

from sweep.constants import TO_MM
from sweep.export.three_mf import xml_bytes

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

LINE, QUAD = 3, 9  # VTK_LINE, VTK_QUAD
TYPES = {"f": "Float64", "i": "Int32"}


def write_shapes(folder: Path, name: str, frames: Mapping[str, Any]) -> list[Path]:
    """Write all stored shapes as NAME_0000.vtu and so on, and NAME.pvd; frames : `read_frames`."""
    files = [folder / f"{name}_{k:04d}.vtu" for k in range(len(frames["strain"]))]
    for k, file in enumerate(files):
        file.write_bytes(_grid(frames, k))
    index = folder / f"{name}.pvd"
    index.write_bytes(_collection(frames["time_s"], [file.name for file in files]))
    return [*files, index]


def _collection(times: NDArray[np.float64], names: list[str]) -> bytes:
    root = Xml.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    collection = Xml.SubElement(root, "Collection")
    for time, name in zip(times, names, strict=True):
        Xml.SubElement(collection, "DataSet", timestep=f"{time:.9g}", part="0", file=name)
    return xml_bytes(root)


def _grid(frames: Mapping[str, Any], k: int) -> bytes:
    """Shape number ``k`` as an unstructured grid of lines or quads."""
    rest, position = (TO_MM * _deep(frames["position_m"][i]) for i in (0, k))
    of_plates = "quads" in frames
    cells_of = np.asarray(frames["quads" if of_plates else "edges"], np.int32)
    thickness = frames["quad_thickness_m" if of_plates else "edge_thickness_m"]
    measure, name = (_areas, "area_strain") if of_plates else (_lengths, "element_strain")
    before, now = (measure(points, cells_of) for points in (rest, position))
    root = Xml.Element("VTKFile", type="UnstructuredGrid", version="0.1", byte_order="LittleEndian")
    grid = Xml.SubElement(root, "UnstructuredGrid")
    _data(Xml.SubElement(grid, "FieldData"), "strain", frames["strain"][k : k + 1], of_field=True)
    sizes = {"NumberOfPoints": str(len(position)), "NumberOfCells": str(len(cells_of))}
    piece = Xml.SubElement(grid, "Piece", sizes)
    _data(Xml.SubElement(piece, "PointData", Vectors="displacement_mm"),
          "displacement_mm", position - rest)  # fmt: skip
    of_cells = Xml.SubElement(piece, "CellData", Scalars="wall_thickness_mm")
    _data(of_cells, "wall_thickness_mm", TO_MM * thickness)
    _data(of_cells, name, now / before - 1.0)
    _data(Xml.SubElement(piece, "Points"), "points", position)
    cells = Xml.SubElement(piece, "Cells")
    count, corners = cells_of.shape
    _data(cells, "connectivity", cells_of.ravel())
    _data(cells, "offsets", corners * np.arange(1, count + 1, dtype=np.int32))
    _data(cells, "types", np.full(count, QUAD if of_plates else LINE, np.int32))
    return xml_bytes(root)


def _deep(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (n, 2) with z = 0, or (n, 3) as they are: (n, 3)."""
    return np.pad(np.asarray(points, np.float64), ((0, 0), (0, 3 - points.shape[1])))


def _lengths(points: NDArray[np.float64], edges: NDArray[np.int32]) -> NDArray[np.float64]:
    """Length of every element."""
    ends = points[edges]
    length: NDArray[np.float64] = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return length


def _areas(points: NDArray[np.float64], quads: NDArray[np.int32]) -> NDArray[np.float64]:
    """Area of every quad: half the product of its diagonals."""
    a, b, c, d = np.moveaxis(points[quads], 1, 0)
    area: NDArray[np.float64] = 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=1)
    return area


def _data(parent: Xml.Element, name: str, values: Any, of_field: bool = False) -> None:
    """Add an array: its numbers as text, a row per line."""
    values = np.asarray(values)
    about = {"type": TYPES[values.dtype.kind], "Name": name, "format": "ascii"}
    if of_field:
        about["NumberOfTuples"] = str(len(values))
    if values.ndim > 1:
        about["NumberOfComponents"] = str(values.shape[1])
    rows = values.reshape(len(values), -1).tolist()
    lines = (" ".join(f"{value:.9g}" for value in row) for row in rows)
    Xml.SubElement(parent, "DataArray", about).text = "\n".join(lines)
