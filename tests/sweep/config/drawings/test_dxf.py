"""Lines and curves of a DXF file; other entities are reported, unreadable files refused."""

import sys

import ezdxf
import numpy as np
import pytest

from sweep.config.drawings import dxf
from sweep.config.drawings.dxf import read_dxf
from sweep.config.faults import MisfitError
from tests.support.designs.drawings import as_dxf


def saved(path, draw, units=4):
    """A file with the entities that `draw` adds to a model space."""
    document = ezdxf.new(units=units)
    draw(document, document.modelspace())
    document.saveas(path)
    return path


def test_curves_of_all_kinds_are_read(tmp_path):
    """A bulge of 1 is half a circle; an ellipse of equal axes and a spline through its poles."""

    def draw(_, space):
        space.add_circle((0, 0), 2)
        space.add_arc((10, 0), 2, 0, 180)
        space.add_ellipse((20, 0), (2, 0), 1.0)
        space.add_lwpolyline([(30, 0, 0, 0, 1), (34, 0)])
        space.add_spline([(40, 0), (42, 1), (44, 0)])
        space.add_line((50, 0), (51, 1))

    ends = read_dxf(saved(tmp_path / "a.dxf", draw)).ends
    count = [len(ends[(ends[:, 0, 0] > x - 3) & (ends[:, 0, 0] < x + 5)]) for x in range(0, 60, 10)]
    assert count[:4] == [32, 16, 32, 16]
    assert count[4] > 4
    assert count[5] == 1
    for place, low in ((0, -2.0), (10, 0.0), (20, -2.0)):
        at = ends[np.abs(ends[:, 0, 0] - place) < 3].reshape(-1, 2) - [place, 0]
        assert np.linalg.norm(at, axis=1) == pytest.approx(2.0, rel=1e-3)
        assert at[:, 1].min() == pytest.approx(low, abs=1e-9)


def test_units_are_those_of_the_file(tmp_path):
    sizes = {0: None, 1: 25.4e-3, 2: 0.3048, 4: 1e-3, 5: 1e-2, 6: 1.0, 9: 25.4e-6, 13: 1e-6}
    for units, size in (sizes | {18: None}).items():
        unit = read_dxf(as_dxf(tmp_path / "a.dxf", units=units)).unit
        assert unit == (size and pytest.approx(size))


def test_what_is_left_out_is_told(tmp_path):
    def draw(document, space):
        document.layers.add("notes").off()
        space.add_line((0, 0), (1, 1))
        space.add_line((0, 0), (9, 9), dxfattribs={"layer": "notes"})
        space.add_line((0, 0), (8, 8), dxfattribs={"invisible": 1})
        space.add_text("10 mm")
        space.add_point((0, 0))

    lines = read_dxf(saved(tmp_path / "a.dxf", draw))
    assert lines.notes == ("left out: 1 x POINT, 1 x TEXT, 2 x hidden line",)
    assert lines.ends.tolist() == [[[0.0, 0.0], [1.0, 1.0]]]


def blocks(document, space):
    """Blocks that hold one another: a million lines in ten rows of text."""
    for level in range(7):
        block = document.blocks.new(f"b{level}")
        for k in range(10):
            if level:
                block.add_blockref(f"b{level - 1}", (k, k))
            else:
                block.add_line((0, 0), (k, 1))
    space.add_blockref("b6", (0, 0))


@pytest.mark.parametrize(
    ("draw", "text"),
    [
        (lambda _, space: space.add_line((0, 0, 0), (1, 1, 1)), "not in the plane"),
        (blocks, "more than 500 entities"),
    ],
)
def test_what_is_no_drawing_in_the_plane_is_refused(tmp_path, monkeypatch, draw, text):
    monkeypatch.setattr(dxf, "MOST_LINES", 500)
    with pytest.raises(MisfitError, match=text):
        read_dxf(saved(tmp_path / "a.dxf", draw))


def test_a_repair_is_told(tmp_path):
    """Release 9 wrote x of both ends, then y."""
    line = ["LINE", 8, "0", 10, 1.5, 11, 2.0, 20, 3.0, 21, 4.0, 30, 0.0, 31, 0.0]
    pairs = [0, "SECTION", 2, "ENTITIES", 0, *line, 0, "ENDSEC", 0, "EOF"]
    (tmp_path / "a.dxf").write_text("\n".join(map(str, pairs)))
    lines = read_dxf(tmp_path / "a.dxf")
    assert lines.ends.tolist() == [[[1.5, 3.0], [2.0, 4.0]]]
    assert lines.notes == ("of an old form or damaged, and repaired by ezdxf: look at its walls",)


def test_damage_and_a_missing_package_are_told(tmp_path, monkeypatch):
    path = tmp_path / "a.dxf"
    path.write_text("no drawing")
    with pytest.raises(MisfitError, match=r"not DXF that ezdxf can read \(OSError"):
        read_dxf(path)
    monkeypatch.setitem(sys.modules, "ezdxf.filemanagement", None)
    with pytest.raises(MisfitError, match=r'pip install ezdxf, or "crumple\[drawings\]"'):
        read_dxf(path)
