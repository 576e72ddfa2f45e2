"""Analysis of a linear system: which walls are condensed, which entries have room, many blocks."""

import numpy as np
import pytest

from kernels.linear.condensed.bundles import CONDENSED, OPEN, RIGID, bundled
from tests.support.kernels.frames import frame, layout_of
from tests.support.kernels.webs import MIXED, WALLS, Problem, couplings, supported, web


@pytest.mark.parametrize(
    ("support", "coupled", "rigid", "open_walls"),
    [
        ("floating", "condensed", [], []),
        ("clamped", "condensed", [0], []),
        ("glued", "condensed", [0, 2], []),
        ("glued and driven", "condensed", [0, 2], []),
        ("clamped", "some open", [0], [3, 4]),
        ("floating", "all open", [], [0, 1, 2, 3, 4, 7]),
        ("glued", "all open", [0, 2], [1, 3, 4, 7]),
    ],
)
def test_walls_are_condensed_unless_something_touches_them(support, coupled, rigid, open_walls):
    """A single element has nothing inside; a wall whose every coordinate is held is rigid."""
    of = web(MIXED)
    kind = Problem(of, supported(of, support), couplings(of, coupled)).found.kind
    expected = np.full(len(WALLS), CONDENSED)
    expected[rigid], expected[open_walls] = RIGID, OPEN
    np.testing.assert_array_equal(kind, expected)


@pytest.mark.parametrize("wall", [4, None], ids=["inside a condensed wall", "joints apart"])
@pytest.mark.parametrize("support", ["floating", "clamped"])
def test_a_contact_has_room_where_it_was_announced(support, wall):
    of = web(MIXED)
    node = 3 if wall is None else int(of.edges[of.start[wall] + 3, 1])
    coupled = np.array([[node, 5, 5]])
    for given, missing in ((coupled[:0], 1), (coupled, 0)):
        problem = Problem(of, supported(of, support), given)
        problem.contacts = [([node, 5], np.eye(6)[:, ::-1] + 1.0)]
        problem.factor()
        assert problem.found.matrix.missing[0] == missing
    assert problem.is_factored(np.ones(problem.n))


def test_only_the_last_bundle_of_walls_of_a_kind_is_incomplete():
    of = web(3)
    bundles = Problem(of, layout_of(of), couplings(of, "some open")).found.bundles
    np.testing.assert_array_equal(bundles.size, [4, 2, 2])


def test_no_walls_are_no_bundles():
    none, start = np.empty(0, np.int64), np.zeros(1, np.int64)
    bundles = bundled(none, start, start, none, np.empty((0, 6), np.int64))
    assert (bundles.wall.shape, bundles.outer.shape) == ((0, 4), (0, 24))


def test_a_frame_of_more_than_128_blocks():
    """Order and pattern of many open walls."""
    joints = [(4.0 * i, 4.0 * j) for j in range(4) for i in range(4)]
    along = [(4 * j + i, 4 * j + i + 1) for j in range(4) for i in range(3)]
    up = [(4 * j + i, 4 * j + i + 4) for j in range(3) for i in range(4)]
    of = frame(joints, along + up, 6)
    inner = of.edges[of.start[:-1], 1]
    coupled = np.column_stack([inner, np.roll(inner, 5), np.roll(inner, 11)])
    problem = Problem(of, layout_of(of, [0, 1, 2]), coupled)
    assert problem.found.matrix.start.size - 1 > 128
    assert problem.factor() == (False, 0.0)
    assert problem.is_factored(np.random.default_rng(0).uniform(-1, 1, problem.n))
