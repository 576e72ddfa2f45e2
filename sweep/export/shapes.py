"""VTKHDF: the shapes of a crush as one file for ParaView (5.12 and later), a grid that moves.

The elements of walls are lines, the elements of plates quads. Points have their displacement, in mm
as all lengths; lines have their wall thickness and the strain of their chord, quads the strain of
their area. Steps have the time and the strain of the lattice. Constant data are stored once:
https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/index.html
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from sweep.array_types import Floats, Ints
from sweep.constants import TO_MM

LINE, QUAD = 3, 9  # VTK_LINE, VTK_QUAD
VERSION = (2, 3)  # version of the format, with field data in steps


def write_shapes(path: Path, frames: Mapping[str, Any]) -> None:
    """Write all stored shapes; frames: `read_frames`."""
    position = TO_MM * np.stack([_deep(points) for points in frames["position_m"]])
    of_plates = "quads" in frames
    cells = np.asarray(frames["quads" if of_plates else "edges"], np.int64)
    measure, name = (_areas, "area_strain") if of_plates else (_lengths, "element_strain")
    sizes = np.stack([measure(points, cells) for points in position])
    steps, points, count = len(position), position.shape[1], len(cells)
    thickness = TO_MM * frames["quad_thickness_m" if of_plates else "edge_thickness_m"]
    every, once = np.arange(steps), np.zeros(steps, np.int64)
    of_points = {"displacement_mm": (position - position[0]).reshape(-1, 3)}
    of_cells = {name: (sizes / sizes[0] - 1.0).ravel(), "wall_thickness_mm": thickness}
    offsets = {name: count * every, "wall_thickness_mm": once}
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = VERSION
        root.attrs.create("Type", b"UnstructuredGrid", dtype="S16")
        _write(root, {
            "NumberOfPoints": [points], "NumberOfCells": [count],
            "NumberOfConnectivityIds": [cells.size], "Points": position.reshape(-1, 3),
            "Connectivity": cells.ravel(), "Offsets": cells.shape[1] * np.arange(count + 1),
            "Types": np.full(count, QUAD if of_plates else LINE, np.uint8),
        })  # fmt: skip
        _write(root.create_group("PointData"), of_points)
        _write(root.create_group("CellData"), of_cells)
        _write(root.create_group("FieldData"), {"strain": frames["strain"]})
        series = root.create_group("Steps")
        series.attrs["NSteps"] = steps
        _write(series, {
            "Values": frames["time_s"], "PartOffsets": once,
            "NumberOfParts": np.ones(steps, np.int64), "PointOffsets": points * every,
            "CellOffsets": once[:, None], "ConnectivityIdOffsets": once[:, None],
        })  # fmt: skip
        _write(series.create_group("PointDataOffsets"), {"displacement_mm": points * every})
        _write(series.create_group("CellDataOffsets"), offsets)
        _write(series.create_group("FieldDataOffsets"), {"strain": every})
        one = np.ones((steps, 2), np.int64)  # component and tuple
        _write(series.create_group("FieldDataSizes"), {"strain": one})


def _write(group: h5py.Group, arrays: Mapping[str, Any]) -> None:
    for name, values in arrays.items():
        group.create_dataset(name, data=values)


def _deep(points: Floats) -> Floats:
    """Points (n, 2) with z = 0, or (n, 3) unchanged: (n, 3)."""
    return np.pad(np.asarray(points, np.float64), ((0, 0), (0, 3 - points.shape[1])))


def _lengths(points: Floats, edges: Ints) -> Floats:
    """Length of every element."""
    ends = points[edges]
    length: Floats = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return length


def _areas(points: Floats, quads: Ints) -> Floats:
    """Area of every quad: half the product of its diagonals."""
    a, b, c, d = np.moveaxis(points[quads], 1, 0)
    area: Floats = 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=1)
    return area
