"""DXF in mm."""

import sys

import ezdxf
import pytest
import shapely

from sweep.export.design import design_of
from sweep.export.dxf import write_dxf
from sweep.export.errors import ExportError
from sweep.export.outline import outline, specimen
from tests.support.results.exported import grid


@pytest.fixture
def part():
    design = design_of(grid(2))
    return specimen(design, outline(design.network))


def test_polylines_are_closed_rings_in_mm(tmp_path, part):
    write_dxf(tmp_path / "part.dxf", part)
    document = ezdxf.readfile(tmp_path / "part.dxf")
    assert document.units == ezdxf.units.MM
    assert not document.audit().errors
    lines = list(document.modelspace())
    assert all(line.dxftype() == "LWPOLYLINE" and line.closed for line in lines)
    assert [line.dxf.layer for line in lines] == ["OUTLINE"] + 4 * ["OPENINGS"]
    outer, *openings = (shapely.polygons(line.get_points("xy")).area for line in lines)
    assert outer - sum(openings) == pytest.approx(part.shape.area, rel=1e-9)


def test_missing_package_is_named(tmp_path, part, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(ExportError, match=r"pip install ezdxf, or \"crumple\[export\]\"; \.svg"):
        write_dxf(tmp_path / "part.dxf", part)
    assert not (tmp_path / "part.dxf").exists()
