"""SVG in mm."""

import re
from xml.etree import ElementTree as Xml

import numpy as np
import pytest
import shapely

from sweep.config.case import Case
from sweep.export.design import design_of
from sweep.export.outline import outline, specimen
from sweep.export.svg import write_svg
from tests.support.designs.infills import lattice_of


def test_rings_are_the_outline_with_y_upwards(tmp_path):
    design = design_of(Case.of(lattice=lattice_of("hex", cells=(2, 1))))
    part = specimen(design, outline(design.network))
    write_svg(tmp_path / "part.svg", part)
    root = Xml.parse(tmp_path / "part.svg").getroot()
    _, _, width, height = part.shape.bounds
    assert float(root.get("width").removesuffix("mm")) == pytest.approx(width, rel=1e-5)
    assert root.get("viewBox") == f"0 0 {width:.6g} {height:.6g}"
    path = root.find("{*}path").get("d")
    closed = [ring for ring in path.split("M") if ring]
    assert all(ring.strip().endswith("Z") for ring in closed)
    rings = [np.array(re.findall(r"[-\d.]+", ring), float).reshape(-1, 2) for ring in closed]
    rings = [np.column_stack([ring[:, 0], height - ring[:, 1]]) for ring in rings]
    drawn = shapely.polygons(rings[0], [shapely.linearrings(ring) for ring in rings[1:]])
    assert len(rings) == 3
    assert shapely.symmetric_difference(drawn, part.shape).area < 1e-6 * part.shape.area
