"""Infill joined to the outline: the frame stays, whatever the density and the perimeters."""

from collections import Counter
from itertools import islice, product

import numpy as np
import pytest

from sweep.config.kinds.table import RefusedError
from sweep.design.drawing import connected
from sweep.design.lattice import build_network
from sweep.design.slicer.joining import joined
from sweep.design.slicer.network import extruded_area
from sweep.design.slicer.patterns import SLICERS
from tests.support.designs.tables import DENSITY, lattice_with

SIZES = [(20e-3, 20e-3), (24e-3, 24e-3)]
SHARES = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]


def laid(size, slicer, pattern, infill, perimeters):
    """A sliced lattice, or the key by which it is refused."""
    values = {"width": size[0], "height": size[1], "infill": infill, "perimeters": perimeters}
    try:
        return lattice_with(slicer=slicer, pattern=pattern, **values)
    except RefusedError as refused:
        return refused.key


def check_frame(network, box, least):
    """Each side is one chain from corner to corner, and all walls hang together; of the infill,
    none that ends on a side is shorter than ``least`` (m).
    """
    ends = network.points[network.walls]
    on = (ends == 0.0) | (ends == box)
    along = ((ends[:, 0] == ends[:, 1]) & on.all(axis=1)).any(axis=1)
    assert network.length[on.any(axis=(1, 2)) & ~along].min() > (1.0 - 1e-6) * least
    for axis, side in product((0, 1), (0, 1)):
        on = (ends[..., axis] == side * box[axis]).all(axis=1)
        along = np.sort(ends[on][..., 1 - axis], axis=1)
        along = along[np.argsort(along[:, 0])]
        assert (along[0, 0], along[-1, 1]) == (0.0, box[1 - axis])
        assert (along[1:, 0] == along[:-1, 1]).all()
    assert (np.ptp(network.points, axis=0) == box).all()
    assert not connected(network.walls, len(network.points)).any()


def test_no_drawing_loses_its_frame():
    """All slicers and patterns, 10 to 80 %, 1 to 6 perimeters: every fifth combination. Infills
    with cells less than twice as wide as their walls are refused.
    """
    patterns = [(slicer, own) for slicer, patterns in SLICERS.items() for own in patterns]
    outcome = Counter()
    combinations = islice(product(SIZES, patterns, SHARES, range(1, 7)), 0, None, 5)
    for size, names, infill, perimeters in combinations:
        lattice = laid(size, *names, infill, perimeters)
        outcome[lattice if isinstance(lattice, str) else "drawn"] += 1
        if not isinstance(lattice, str):
            least = lattice.line + 0.5 * lattice.outline[0]
            check_frame(build_network(lattice.geometry), size, least)
    assert outcome == {"drawn": 234, "lattice.infill": 54}


@pytest.mark.parametrize(
    ("infill", "grams"), [(0.5, 3.43), (0.55, 3.61), (0.6, 3.79), (0.7, 4.15), (0.8, 4.51)]
)
def test_dense_grids_have_the_mass_that_is_extruded(infill, grams):
    """Lines overlap where they cross: of shares r / 2 of both directions, r^2 / 4 is one."""
    lattice = laid((20e-3, 15e-3), "prusa", "grid", infill, 4)
    per_area = 1e3 * DENSITY * lattice.depth
    extruded = per_area * extruded_area(lattice.geometry)
    assert extruded == pytest.approx(grams, abs=0.005)
    between = (20e-3 - lattice.outline[0]) * (15e-3 - lattice.outline[1])
    crossings = per_area * 0.25 * infill**2 * between
    drawn = per_area * build_network(lattice.geometry).printed_area
    assert drawn + crossings == pytest.approx(extruded, rel=0.04)


def test_a_dense_drawing_is_the_same_upside_down():
    points = build_network(laid(SIZES[1], "prusa", "grid", 0.8, 4).geometry).points
    turned = 24e-3 - points
    assert np.linalg.norm(points[:, None] - turned, axis=2).min(axis=1).max() < 1e-9


def test_parallel_lines_stay_apart_under_many_perimeters():
    """Their ends are nearer to one another than the length over which a single short wall is
    joined.
    """
    lattice = laid(SIZES[0], "prusa", "alignedrectilinear", 0.4, 6)
    network = build_network(lattice.geometry)
    ends = network.points[network.walls[network.wall_thickness < 1.5 * lattice.line]]
    step = lattice.fill_distance * 2.0**0.5
    assert len(ends) == 2 * int(20e-3 / step - 0.5) + 1
    on_bottom = np.sort(ends[ends[..., 1] == 0.0][:, 0])
    assert np.diff(on_bottom)[2:-2] == pytest.approx(step)


BOX = np.array([10.0, 8.0])


def walls_of(lines, least, apart=5.0):
    """Joined walls by their ends, as sets of points."""
    points, walls = joined(np.array(lines, float), BOX, least, apart)
    return {frozenset((tuple(points[a]), tuple(points[b]))) for a, b in walls}


def test_a_crossing_near_a_side_comes_to_it():
    """Between the ends of both of its short walls."""
    lines = [((3, 0), (7, 4)), ((5, 0), (1, 4)), ((1, 4), (7, 4)), ((7, 4), (10, 4))]
    crossed = [((3, 0), (4, 1)), ((4, 1), (7, 4)), ((5, 0), (4, 1)), ((4, 1), (1, 4)), *lines[2:]]
    walls = walls_of(crossed, least=1.5)
    assert {frozenset({(4.0, 0.0), (7.0, 4.0)}), frozenset({(4.0, 0.0), (1.0, 4.0)})} <= walls
    assert not any({(3.0, 0.0), (5.0, 0.0)} & wall for wall in walls)


def test_an_end_stays_though_its_line_comes_to_the_side():
    """It is a joint of the outline, but not if that makes pieces shorter than walls may be."""
    lines = [((3, 0), (4, 1)), ((4, 1), (7, 8)), ((5, 0), (4, 1)), ((4, 1), (1, 8))]
    for end, stays in ((8, True), (5.4, False)):
        walls = walls_of([*lines, ((4, 1), (end, 0))], least=1.5)
        assert frozenset({(4.0, 0.0), (float(end), 0.0)}) in walls or not stays
        assert any((float(end), 0.0) in wall for wall in walls) == stays


def test_ends_near_a_corner_come_to_it_and_what_lies_across_it_goes():
    across = ((1, 0), (0, 1))
    walls = walls_of([across, ((0.5, 0), (5, 8))], least=1.5)
    assert frozenset({(0.0, 0.0), (5.0, 8.0)}) in walls
    assert len(walls) == 6  # the line, and five pieces of the outline


def test_a_row_of_near_ends_does_not_become_one():
    """Nearest ones do; the corners stay."""
    at = [2.0, 2.4, 3.4, 3.8, 4.8, 5.2, 6.2, 6.6, 7.6, 8.0]
    walls = walls_of([((x, 0), (x, 8)) for x in at], least=2.5, apart=1.0)
    bottom = sorted({x for wall in walls for x, y in wall if y == 0.0})
    assert bottom == pytest.approx([0.0, 2.2, 3.6, 5.0, 6.4, 7.8, 10.0])
