"""STL, binary: triangles in mm, without a unit in the file."""

from pathlib import Path

import numpy as np

from sweep.export.solid import Body

HEADER = b"binary STL in mm, by Crumple".ljust(80)
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(path: Path, body: Body) -> None:
    """Write a body: 80 bytes, the number of triangles, then 50 bytes for each.

    A triangle without area, between points of one line, has the normal 0.
    """
    corners = body.points[body.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    records = np.zeros(len(corners), RECORD)
    records["normal"] = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0.0)
    records["corners"] = corners
    path.write_bytes(HEADER + np.uint32(len(corners)).astype("<u4").tobytes() + records.tobytes())
