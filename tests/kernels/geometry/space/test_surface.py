"""Edges of triangulated surfaces and the strips that belong to them."""

import itertools

import numpy as np
import pytest

from kernels.geometry.space import surface
from tests.support.kernels.surfaces import Sheet


@pytest.mark.parametrize(("across", "along"), [(1, 1), (3, 2), (5, 7)])
def test_edges_of_a_sheet(across, along):
    sheet = Sheet(across, along)
    edges, sides = surface.edges_of(sheet.triangles, len(sheet.points))
    expected = {
        frozenset((t[i], t[(i + 1) % 3])) for t, i in itertools.product(sheet.triangles, range(3))
    }
    assert {frozenset(e) for e in edges} == expected
    assert len(edges) == len(expected)
    for k, t in enumerate(sheet.triangles):
        for i in range(3):
            assert set(edges[sides[k, i]]) == {t[i], t[(i + 1) % 3]}


def test_edges_where_walls_meet():
    """Three triangles share one edge."""
    triangles = np.array([(0, 1, 2), (1, 0, 3), (0, 1, 4)])
    edges, sides = surface.edges_of(triangles, 5)
    assert len(edges) == 7
    assert sides[0, 0] == sides[1, 0] == sides[2, 0]


def test_strips_cover_the_surface_once():
    sheet = Sheet(4, 3, 2.0, 1.5)
    edges, sides = surface.edges_of(sheet.triangles, len(sheet.points))
    widths = surface.widths(sheet.points, sheet.triangles, edges, sides)
    lengths = np.linalg.norm(np.diff(sheet.points[edges], axis=1)[:, 0], axis=1)
    assert widths @ lengths == pytest.approx(3.0)
    assert surface.area(sheet.points, sheet.triangles, 0) == pytest.approx(0.125)
