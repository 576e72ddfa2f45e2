"""Families of infill: their drawings, how much of it, and that it rests."""

import numpy as np
import pytest
import shapely

import sweep.design.infill
from sweep.config.case import Case
from sweep.design.drawing import Sketch, connected, counts, extent, joints_and_walls
from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.design.network import relative_density
from sweep.scene.lattice import build_scene
from tests.support.designs.infills import EDGES, KINDS, lattice_of
from tests.support.kernels.solving import whole

COUNTS = {  # joints and walls of 3 x 3 and of 4 x 5 cells
    "square": ((16, 24), (30, 49)),
    "brick": ((22, 31), (46, 67)),
    "hex": ((30, 38), (58, 77)),
    "reentrant": ((30, 38), (58, 77)),
    "diamond": ((24, 36), (49, 80)),
    "circle": ((96, 108), (209, 240)),
    "triangle": ((14, 28), (27, 61)),
    "kagome": ((35, 58), (72, 126)),
}


@pytest.mark.parametrize(("kind", "way"), [pair for pair in KINDS if pair[0] in COUNTS])
def test_joints_and_walls_are_as_many_as_counted_by_hand(kind, way):
    for cells, expected in zip([(3, 3), (4, 5)], COUNTS[kind], strict=True):
        drawn = Sketch(kind, way, cells if way == "pointy" else cells[::-1], (1.0, 2.0))
        points, walls = joints_and_walls(drawn)
        assert (len(points), len(walls)) == counts(drawn) == expected


def crossings(points, walls):
    """Places in mm where walls cross, overlap, or end on another one, without a vertex there."""
    lines = shapely.linestrings(1e3 * points[walls])
    pairs = shapely.STRtree(lines).query(lines, "intersects").T
    pairs = pairs[pairs[:, 0] < pairs[:, 1]]
    met = shapely.intersection(*lines[pairs.T])
    apart = shapely.distance(shapely.boundary(lines[pairs]), met[:, None]).max(axis=1) > 1e-6
    ends = shapely.get_type_id(met) == shapely.GeometryType.POINT
    return shapely.get_coordinates(shapely.centroid(met[apart | ~ends])).round(3).tolist()


@pytest.mark.parametrize("cells", [(1, 1), (3, 3), (2, 4)])
@pytest.mark.parametrize(("kind", "way"), KINDS)
def test_walls_meet_in_joints_only(kind, way, cells):
    network = build_network(lattice_of(kind, way, cells).geometry)
    found = crossings(network.points, network.walls)
    assert not found, f"walls of {kind} cross at {found[0]} mm: draw a vertex there in both lines"


@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("cells", [(1, 1), (3, 3), (2, 4)])
@pytest.mark.parametrize(("kind", "way"), KINDS)
def test_a_lattice_fills_its_box_and_hangs_together(kind, way, cells, edge):
    """No wall ends in the air, except in solid layers, which end with the box."""
    network = build_network(lattice_of(kind, way, cells, **EDGES[edge]).geometry)
    points, walls = network.points, network.walls
    assert points.min(axis=0).tolist() == [0.0, 0.0]
    np.testing.assert_allclose(points.max(axis=0), [20e-3, 18e-3], rtol=1e-12)
    n = len(points)
    assert not connected(walls, n).any()
    ends = np.bincount(walls.ravel(), minlength=n) < 2
    corners = np.isin(points[:, 0], [0.0, 20e-3]) & np.isin(points[:, 1], [0.0, points[:, 1].max()])
    assert not np.any(ends & ~(corners if edge == "capped" else False))
    for row, y in ((network.bottom, 0.0), (network.top, points[:, 1].max())):
        np.testing.assert_array_equal(row, np.flatnonzero(points[:, 1] == y))
        assert np.all(np.diff(points[row, 0]) > 0.0)


def overlaps(points, walls):
    """Sum over all openings g between neighbouring arms of cot(g / 2)."""
    total = 0.0
    for joint in range(len(points)):
        others = walls[(walls == joint).any(axis=1)].sum(axis=1) - joint
        arms = points[others] - points[joint]
        bearing = np.sort(np.arctan2(arms[:, 1], arms[:, 0]))
        total += np.sum(1.0 / np.tan(0.5 * np.diff(bearing, append=bearing[0] + 2 * np.pi)))
    return total


@pytest.mark.parametrize(("kind", "way"), KINDS)
def test_printed_area_counts_joints_once(kind, way):
    """T L - t^2/4 sum cot(g/2): the area that two arms share, or lack outside a corner."""
    low, high = extent(kind, way, (3, 3))
    width, height = 4e-3 * (high - low)  # regular: no corner is sharper than 60 degrees
    network = build_network(lattice_of(kind, way, width=width, height=height).geometry)
    t = 0.2e-3
    expected = t * network.length.sum() - 0.25 * t**2 * overlaps(network.points, network.walls)
    assert network.printed_area == pytest.approx(expected, rel=1e-11)


def test_regular_honeycomb_in_closed_form():
    """(3 + 1/2) pitches and 5 sides; 38 walls of one side, 14 joints of three arms, 16 corners."""
    side, t = 4e-3, 0.3e-3
    box = {"width": 3.5 * 3**0.5 * side, "height": 5 * side}
    lattice = lattice_of("hex", wall_thickness=t, **box)
    network = build_network(lattice.geometry)
    np.testing.assert_allclose(network.length, side, rtol=1e-12)
    sixty = 1.0 / np.tan(np.pi / 3)
    assert np.bincount(np.bincount(network.walls.ravel())).tolist() == [0, 0, 14, 16]
    area = 38 * side * t - 0.25 * t**2 * 16 * 3 * sixty
    assert network.printed_area == pytest.approx(area, rel=1e-12)
    outer = (3.5 * 3**0.5 * side + t) * (5 * side + t)
    assert relative_density(network, lattice.outer_size) == pytest.approx(area / outer, rel=1e-12)


MIRRORS = {  # signs of x and y under which three rows, four rows look the same
    "square": ([(-1, 1), (1, -1)], [(-1, 1), (1, -1)]),
    "brick": ([(-1, 1), (1, -1)], [(-1, 1)]),
    "hex": ([(1, -1)], [(-1, -1)]),
    "reentrant": ([(1, -1)], [(-1, -1)]),
    "diamond": ([(-1, 1), (1, -1)], [(-1, 1), (1, -1)]),
    "circle": ([(-1, 1), (1, -1)], [(-1, 1), (1, -1)]),
    "triangle": ([(-1, 1)], [(-1, 1), (1, -1)]),
    "kagome": ([(1, -1)], [(-1, -1)]),
}


@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("rows", [3, 4])
@pytest.mark.parametrize("kind", MIRRORS)
def test_a_lattice_is_its_own_mirror_image(kind, rows, edge):
    network = build_network(lattice_of(kind, cells=(3, rows), **EDGES[edge]).geometry)
    ends = network.points[network.walls] - 0.5 * network.points.max(axis=0)

    def drawn(signs):
        """Walls as sorted pairs of points, on a grid finer than any wall."""
        grid = np.round(ends * signs / 1e-8 + 0.3).astype(int)
        return {tuple(sorted(map(tuple, wall))) for wall in grid.tolist()}

    for signs in MIRRORS[kind][rows - 3]:
        assert len(drawn(signs) ^ drawn((1, 1))) == 0


@pytest.mark.parametrize("edge", [*EDGES, "graded"])
@pytest.mark.parametrize(("kind", "way"), KINDS)
def test_every_family_is_free_of_stress_at_rest(kind, way, edge):
    edges = EDGES | {"graded": {"grading": 3.0}}
    lattice = lattice_of(kind, way, (2, 3), **edges[edge], imperfection=0.1)
    press = dict(mode="displacement", platen="contact")
    scene = build_scene(Case.of(lattice=lattice, loading=press))
    rest = whole(scene, scene.x_rest)
    assert np.abs(rest.gradient(scene.x_rest)).max() < 1e-10  # N, N m
    assert rest.energy(scene.x_rest) < 1e-13  # J


def test_a_file_more_is_a_family_more(tmp_path, monkeypatch):
    (tmp_path / "ladder.py").write_text(
        "from sweep.design.infill import tile\n"
        "def draw(columns, rows):\n"
        "    return [tile([(0, 1), (0, 0), (1, 0), (1, 1)], columns, rows)]\n"
    )
    monkeypatch.setattr(
        sweep.design.infill, "__path__", [*sweep.design.infill.__path__, str(tmp_path)]
    )
    families.cache_clear()
    assert "ladder" in families()
    points, walls = joints_and_walls(Sketch("ladder", None, (1, 3), (1.0, 3.0)))
    assert (len(points), len(walls)) == (8, 9)
    families.cache_clear()
