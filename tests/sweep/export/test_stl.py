"""Binary STL."""

import numpy as np
import pytest
import trimesh

from sweep.export.solid import Body
from sweep.export.stl import write_stl

CUBE = trimesh.creation.box((10.0, 20.0, 30.0))


@pytest.fixture
def path(tmp_path):
    write_stl(tmp_path / "part.stl", Body(np.array(CUBE.vertices), np.array(CUBE.faces)))
    return tmp_path / "part.stl"


def test_another_program_reads_the_body(path):
    mesh = trimesh.load_mesh(path)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(6000.0)
    assert mesh.extents == pytest.approx([10.0, 20.0, 30.0])
    content = path.read_bytes()
    assert len(content) == 84 + 50 * 12
    assert not content.startswith(b"solid")  # as a text STL does


def test_normals_point_outwards(path):
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    sides = np.frombuffer(path.read_bytes()[84:], record)
    assert np.linalg.norm(sides["normal"], axis=1) == pytest.approx(1.0)
    assert ((sides["normal"] * sides["corners"].mean(axis=1)).sum(axis=1) > 4.9).all()


def test_triangle_without_area_has_no_normal(path):
    points = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]])
    write_stl(path, Body(points, np.array([[0, 1, 2]])))
    assert np.frombuffer(path.read_bytes()[84:96], "<f4").tolist() == [0.0, 0.0, 0.0]
