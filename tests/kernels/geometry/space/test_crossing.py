"""The check of crossings: through a triangle, beside it, and undecided."""

import numpy as np
import pytest

from kernels.geometry.space import crossing, surface
from kernels.geometry.space.crossing import ACROSS, APART, UNSURE
from tests.support.kernels.surfaces import Sheet, united

TRIANGLE = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)


@pytest.mark.parametrize(
    ("p", "q", "expected"),
    [
        ((0.2, 0.2, -1.0), (0.2, 0.3, 1.0), ACROSS),
        ((0.2, 0.2, 1e-9), (0.2, 0.3, -1e-9), ACROSS),
        ((0.2, 0.2, 0.5), (0.2, 0.3, 1.0), APART),
        ((0.9, 0.9, -1.0), (0.9, 0.8, 1.0), APART),
        ((-0.1, -0.1, -1.0), (-0.1, -0.1, 1.0), APART),
        ((0.2, 0.2, 0.0), (0.2, 0.3, 1.0), UNSURE),
        ((0.5, 0.0, -1.0), (0.5, 0.0, 1.0), UNSURE),
        ((0.5, -1.0, 0.0), (0.2, 0.2, 0.0), UNSURE),
        ((2.0, 0.0, 0.0), (3.0, 1.0, 0.0), APART),
        ((0.6, 0.6, 0.0), (2.0, 1.0, 0.0), APART),
    ],
)
def test_one_edge(p, q, expected):
    assert crossing.relation(*TRIANGLE, p, q) == expected
    assert crossing.relation(*TRIANGLE, q, p) == expected


def counted(points, triangles):
    edges, _ = surface.edges_of(triangles, len(points))
    unsure = np.empty((10, 2), np.int64)
    return crossing.count(points, triangles, edges, unsure), unsure, edges


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_a_flat_sheet_does_not_cross_itself(turn):
    sheet = Sheet(6, 5, 2.0, 3.0)
    basis = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
    assert counted(sheet.points @ basis.T, sheet.triangles)[0] == (0, 0)


def test_two_sheets():
    one, two = Sheet(4, 4), Sheet(3, 3, 0.9, 0.8, (0.037, 0.021, 0.0))
    points, triangles, _ = united(one, two)
    upper = slice(len(one.points), None)
    points[upper, 2] = 0.1
    assert counted(points, triangles)[0] == (0, 0)
    points[len(one.points) + 5, 2] = -0.1
    (crossed, undecided), _, edges = counted(points, triangles)
    assert undecided == 0
    brute = sum(
        crossing.relation(*(tuple(points[i]) for i in (*t, *e))) == ACROSS
        for t in triangles
        for e in edges
        if not set(t) & set(e)
    )
    assert crossed == brute > 4


def test_undecided_pairs_are_listed():
    one, two = Sheet(1, 1), Sheet(1, 1, 0.2, 0.2, (0.6, 0.1, 0.0))
    points, triangles, _ = united(one, two)
    points[4:, 2] = 0.0
    (crossed, undecided), unsure, edges = counted(points, triangles)
    assert crossed == 0
    assert undecided > 0
    for k, e in unsure[: min(undecided, 10)]:
        assert crossing.relation(*(tuple(points[i]) for i in (*triangles[k], *edges[e]))) == UNSURE
