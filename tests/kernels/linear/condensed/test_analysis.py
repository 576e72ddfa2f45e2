"""Analysis of a linear system: which walls are condensed, which entries have room, many blocks."""

import numpy as np
import pytest

from kernels.linear.condensed.bundles import CONDENSED, OPEN, RIGID
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


@pytest.mark.parametrize("support", ["floating", "clamped"])
def test_a_node_of_a_condensed_wall_has_no_room_for_a_contact(support):
    of = web(MIXED)
    inner = int(of.edges[of.start[4] + 3, 1])
    coupled = np.array([[inner, 5, 5]])
    for given, missing in ((coupled[:0], 1), (coupled, 0)):
        problem = Problem(of, supported(of, support), given)
        problem.contacts = [([inner, 5], np.eye(6)[:, ::-1] + 1.0)]
        problem.factor()
        assert problem.found.matrix.missing[0] == missing
    assert problem.is_factored(np.ones(problem.n))


def test_joints_without_a_common_wall_have_no_room_for_a_contact():
    of = web(MIXED)
    for given, missing in (([], 1), ([[5, 3, 3]], 0)):
        coupled = np.array(given, dtype=np.int64).reshape(-1, 3)
        problem = Problem(of, supported(of, "floating"), coupled)
        problem.contacts = [([5, 3], np.eye(6) + 1.0)]
        problem.factor()
        assert problem.found.matrix.missing[0] == missing


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
