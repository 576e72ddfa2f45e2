"""The network that a slicer prints, and its extruded volume."""

from math import radians

import numpy as np
import pytest

from sweep.design.drawing import connected
from sweep.design.geometry import Geometry
from sweep.design.lattice import build_network
from sweep.design.slicer.network import extruded_area, infill
from sweep.design.slicer.patterns import PATTERNS, InfillLines, distance_of, line_of

LINE = line_of("prusa", 0.45e-3, 0.2e-3)
LATERAL = [name for name, pattern in PATTERNS.items() if pattern.slopes]
ANGLES = [(name, angle) for name in PATTERNS if name not in LATERAL for angle in (0.0, 30.0, 45.0)]


def geometry(pattern, share=0.2, angle=None, size=20e-3, perimeters=2, line=LINE):
    """The drawing of a pattern in a square, at its usual fill angle."""
    angle = (0.0 if pattern in LATERAL else 45.0) if angle is None else angle
    distance, inset = distance_of(pattern, share, line), (0.5 * perimeters - 0.25) * line
    sliced = InfillLines(pattern, distance, radians(angle), line, (inset, inset))
    outline = (perimeters * line,) * 2
    wall = PATTERNS[pattern].wall * line
    return Geometry("square", None, (1, 1), (size, size), wall, outline=outline, sliced=sliced)


def infill_density(pattern, share, line=LINE):
    """Share of a large part that is extruded, without its perimeters."""
    drawn = geometry(pattern, share, size=0.25, perimeters=0, line=line)
    drawn = drawn._replace(sliced=drawn.sliced._replace(inset=(0.0, 0.0)))
    return extruded_area(drawn) / 0.25**2


@pytest.mark.parametrize(("share", "printed"), [(0.1, 13.0), (0.35, 42.6)])
def test_honeycomb_extrudes_more_than_it_says(share, printed):
    assert 100.0 * infill_density("honeycomb", share) == pytest.approx(printed, abs=0.05)


@pytest.mark.parametrize("pattern", [name for name in PATTERNS if name != "honeycomb"])
def test_other_patterns_extrude_what_they_say(pattern):
    rows = 7e-3 if pattern in LATERAL else 2e-3  # those of a lateral pattern lie along the sides
    assert infill_density(pattern, 0.2) == pytest.approx(0.2, rel=rows)


@pytest.mark.parametrize("pattern", PATTERNS)
def test_lines_turn_with_the_fill_angle(pattern):
    """Lines of honeycomb have the directions of triangles."""
    turned = {"honeycomb": 3, "lateral-honeycomb": 3, "lateral-lattice": 2}
    count = turned.get(pattern, PATTERNS[pattern].spacing)
    first = {"lateral-lattice": 45.0, "lateral-honeycomb": 30.0}.get(pattern, 0.0)
    for angle in (0.0, 20.0):
        lines = infill(geometry(pattern, angle=angle).sliced, (0.02, 0.02))
        along = np.diff(lines, axis=1)[:, 0]
        bearing = np.degrees(np.arctan2(along[:, 1], along[:, 0])) % 180.0
        found = np.unique(bearing.round(6) % 180.0)
        expected = angle + first + 180.0 / count * np.arange(count)
        assert found == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize(("pattern", "angle"), [*ANGLES, *((name, 0.0) for name in LATERAL)])
@pytest.mark.parametrize("share", [0.1, 0.25])
def test_networks_are_in_one_piece_and_have_no_slivers(pattern, angle, share):
    drawn = geometry(pattern, share, angle)
    network = build_network(drawn)
    points, walls = network.points, network.walls
    assert not connected(walls, len(points)).any()
    ends, length = points[walls], network.length
    beside = np.any((ends == 0.0) | (ends == 20e-3), axis=(1, 2))
    assert length.min() >= LINE
    assert length[beside].min() > (2.0 - 1e-6) * LINE  # a line beside half of two perimeters
    assert (points.min(), points.max()) == (0.0, 20e-3)
    for x, y in ((0.0, 0.0), (20e-3, 0.0), (0.0, 20e-3), (20e-3, 20e-3)):
        assert ((points == (x, y)).all(axis=1)).sum() == 1
    slopes = PATTERNS[pattern].slopes
    infills = {LINE * np.cos(slope) for slope in slopes} or {drawn.wall_thickness}
    assert set(network.wall_thickness) == infills | {2 * LINE}


@pytest.mark.parametrize("pattern", PATTERNS)
def test_patterns_look_the_same_upside_down(pattern):
    points = build_network(geometry(pattern)).points
    turned = 20e-3 - points
    gaps = np.linalg.norm(points[:, None] - turned, axis=2).min(axis=1)
    assert gaps.max() < 1e-9


def lines_of_a_layer(pattern, height, s):
    """Places of OrcaSlicer's lines in a layer at a height, with a share of 1, and their distance.

    As `FillRectilinear.cpp` of OrcaSlicer at commit 0210c8ac has them: of the honeycomb, a third of
    the vertical period is below a joint, where two lines come together, and every other period is
    shifted.
    """
    if pattern == "lateral-lattice":
        return [height, -height], 2.0 * s
    half = 2.0 / 3.0 * s
    third = half / np.tan(np.radians(60.0))
    number = np.floor(height / third)
    shift = half if (number + 1) // 3 % 2 else 0.0
    if (number + 1) % 3:
        return [shift], 2.0 * half
    apart = half * (number + 1 - height / third)
    return [shift - apart, shift + apart], 2.0 * half


@pytest.mark.parametrize("pattern", LATERAL)
def test_walls_are_where_layers_have_lines(pattern):
    """From the lower end of an upright wall, or from a joint, which is the middle of the box."""
    sliced = InfillLines(pattern, distance_of(pattern, 1.0, LINE), 0.0, LINE, (0.0, 0.0))
    ends = infill(sliced, (40.0 * LINE, 40.0 * LINE)) - 20.0 * LINE
    side = PATTERNS[pattern].side * sliced.distance
    zero = (sliced.distance / 2.0, -side / 2.0) if pattern == "lateral-honeycomb" else (0.0, 0.0)
    ends = ends - zero
    for height in np.random.default_rng(0).uniform(0.0, 6.0 * LINE, 40):
        (x0, y0), (x1, y1) = ends[:, 0].T, ends[:, 1].T
        cut = (y0 - height) * (y1 - height) < 0.0
        drawn = x0[cut] + (x1 - x0)[cut] * (height - y0[cut]) / (y1 - y0)[cut]
        drawn = drawn[np.abs(drawn) < 10.0 * LINE]
        places, distance = lines_of_a_layer(pattern, height, LINE)
        away = (drawn[:, None] - places) / distance
        away = np.abs(away - away.round())
        assert away.min(axis=1).max() < 1e-6
        assert away.min(axis=0).max() < 1e-6
        assert len(drawn) == pytest.approx(20.0 * LINE / distance * len(places), abs=2)


def test_only_walls_of_honeycomb_bend_otherwise():
    network = build_network(geometry("honeycomb"))
    within = network.wall_thickness < 1.5 * LINE
    assert set(network.gyration[within]) == {PATTERNS["honeycomb"].gyration}
    assert set(network.gyration[~within]) == {1.0}
    assert set(build_network(geometry("grid")).gyration) == {1.0}


def test_crossings_are_extruded_twice():
    """The union has less than is extruded: at crossings, and where lines reach the outline."""
    drawn = geometry("grid", angle=0.0, perimeters=1)
    network = build_network(drawn)
    lines = 2 * 10.0  # 20 mm at 4.07 mm: 5 lines each way, one in the middle
    crossings = 5 * 5
    more = extruded_area(drawn) - network.printed_area
    overlapping = lines * 0.25 * LINE**2
    assert more == pytest.approx(crossings * LINE**2 + overlapping, rel=1e-6)
