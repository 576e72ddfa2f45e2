"""The linear system: condensed, open and rigid walls between joints, against dense algebra."""

import numpy as np
import pytest

from kernels.linear import analysis, block_matrix, system
from kernels.linear.analysis import CONDENSED, OPEN, RIGID
from tests.support.frames import frame, layout_of, walls_of
from tests.support.terms import assembled, by_home, room

JOINTS = [(0, 0), (4, 0), (4, 3), (0, 3), (2, 1.5), (6, 1)]
WALLS = [(0, 1), (1, 2), (3, 2), (0, 4), (4, 2), (4, 1), (1, 5), (0, 3)]
MIXED = (3, 2, 4, 4, 12, 1, 1, 2)


def web(pieces):
    """Six joints with eight walls, the first one a base and the third one a top."""
    return frame(JOINTS, WALLS, pieces)


def coordinates(of, wall):
    """x, y and rotations of a wall with its joints."""
    span = slice(of.start[wall], of.start[wall + 1])
    nodes = np.unique(of.edges[span])
    return 2 * nodes, 2 * nodes + 1, 2 * len(of.points) + nodes[nodes < of.joints]


def supported(of, kind):
    """Layout of a frame that floats, is clamped below, or is glued between platens."""
    base, (x, y, rotation) = np.concatenate(coordinates(of, 0)), coordinates(of, 2)
    if kind == "floating":
        return layout_of(of)
    if kind in ("clamped", "led from above"):
        return layout_of(of, base, driven=kind != "clamped")
    held = np.concatenate([base, x, rotation])
    return layout_of(of, held, y, driven=kind == "glued and driven")


SUPPORTS = ["floating", "clamped", "led from above", "glued", "glued and driven"]


def couplings(of, which):
    """Nodes that share a term, so that no wall, two of them or all are open."""
    inner = [of.edges[k, 1] for k in of.start[:-1] if of.edges[k, 1] >= of.joints]
    rows = {
        "condensed": [],
        "some open": [[node, node, 0] for node in inner[3:5]],
        "all open": [[node, 3, 0] for node in inner],
        "in contact": [[inner[-1], inner[3], of.edges[of.start[3] + 1, 1]], [5, inner[4], 2]]
        if len(inner) > 4
        else [[5, 4, 0], [3, 5, 1]],
        "on platens": [[p, p, len(of.points)] for p in (3, 4, *inner[:4])],
    }[which]
    return np.array(rows, dtype=np.int64).reshape(-1, 3)


COUPLINGS = ["condensed", "some open", "all open", "in contact", "on platens"]


def random_stiffness(of, rng):
    """Positive definite in all elements and rotations, but for how they lie together."""
    _, stiffness = room(walls_of(of))
    for part in stiffness:
        part[:] = rng.uniform(-1, 1, part.shape)
    stiffness.own[[0, 2]] += 5.0
    stiffness.arm[2] += 3.0
    stiffness.next[:, of.start[1:] - 1] = 0.0  # no hinge behind the last element
    stiffness.twist[of.pieces[of.start[:-1]] > 1] = 0.0
    return stiffness


class Problem:
    """A frame of random stiffness and mass, its couplings as contacts: dense and factored."""

    def __init__(self, of, layout, coupled, seed=0, mass=1.0):
        rng = np.random.default_rng(seed)
        self.of, self.layout, self.walls = of, layout, walls_of(of)
        self.n = of.rest.size
        self.stiffness = random_stiffness(of, rng)
        self.diagonal = mass * rng.uniform(0.5, 1.0, self.n)
        self.contacts = [(nodes, rng.uniform(-1, 1, (6, 6))) for nodes in coupled.tolist()]
        self.found = analysis.analyse(layout, self.walls, coupled)

    def dense(self):
        """Hessian (n, n) by coordinate."""
        full = assembled(self.walls, self.stiffness, self.n) + np.diag(self.diagonal)
        for nodes, half in self.contacts:
            self._contact(nodes, half, lambda i, j, value: _put(full, i, j, value))
        return full

    def _contact(self, nodes, half, add):
        """Semi-definite contact of nodes; the upper platen has one coordinate and stands last."""
        where = [c for p in dict.fromkeys(nodes) for c in self._of(p)]
        square = half[: len(where), : len(where)]
        square = square @ square.T
        for a, i in enumerate(where):
            for b in range(a + 1):
                add(i, where[b], square[a, b])

    def _of(self, point):
        return (2 * point, 2 * point + 1) if point < len(self.of.points) else (self.n - 1,)

    def factor(self):
        """Place of the first negative pivot."""
        matrix = self.found.matrix
        block_matrix.clear(matrix)
        matrix.diagonal[:] = self.diagonal
        for nodes, half in self.contacts:
            self._contact(nodes, half, lambda i, j, value: block_matrix.add(matrix, i, j, value))
        return system.factor(self.found, self.layout, self.walls, self.stiffness, False, False)

    def solve(self, b):
        """Solution by coordinate after the factor."""
        y = b.copy()
        system.solve(self.found, self.layout, y)
        return y

    def reduction(self):
        """Matrix (n, free) from what is solved for to coordinates."""
        leader = self.layout.leader
        free = [c for c in np.unique(leader[leader >= 0]) if c != self.layout.driven]
        return (leader[:, None] == np.array(free)).astype(float)

    def is_factored(self, b, rtol=1e-9):
        """Whether the solution for ``b`` is that of dense algebra."""
        R = self.reduction()
        expected = R @ np.linalg.solve(R.T @ self.dense() @ R, R.T @ b)
        return np.allclose(self.solve(b), expected, rtol=0, atol=rtol * np.abs(expected).max())


def _put(full, i, j, value):
    full[i, j] += value
    if i != j:
        full[j, i] += value


@pytest.mark.parametrize("pieces", [1, 2, 3, 4, 12, MIXED])
@pytest.mark.parametrize("coupled", COUPLINGS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_factor_and_solve(support, coupled, pieces):
    of = web(pieces)
    problem = Problem(of, supported(of, support), couplings(of, coupled))
    assert problem.factor() == (False, 0.0)
    assert problem.found.matrix.missing[0] == 0
    assert problem.is_factored(np.random.default_rng(1).uniform(-1, 1, problem.n))


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


@pytest.mark.parametrize("coupled", COUPLINGS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_it_can_be_factored_again(support, coupled):
    of = web(MIXED)
    problem = Problem(of, supported(of, support), couplings(of, coupled))
    for seed in range(3):
        problem.stiffness = random_stiffness(of, np.random.default_rng(seed))
        assert not problem.factor()[0]
        assert problem.is_factored(np.random.default_rng(seed).uniform(-1, 1, problem.n))


def weakened(problem, c):
    """Make the stiffness of coordinate ``c`` negative."""
    problem.diagonal[c] -= 1.5 * problem.dense()[c, c]


@pytest.mark.parametrize("coupled", COUPLINGS)
@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("seed", range(4))
def test_descent_along_a_negative_pivot(seed, support, coupled):
    """d^T A d is that pivot; d is admissible: what is tied moves together, what is held stays."""
    of = web(MIXED)
    problem = Problem(of, supported(of, support), couplings(of, coupled), seed)
    rng = np.random.default_rng(seed)
    free = np.flatnonzero(problem.layout.leader == np.arange(problem.n))
    free = free[free != problem.layout.driven]
    for c in rng.choice(free, 12, replace=False):
        kept = problem.diagonal[c]
        weakened(problem, c)
        failed, pivot = problem.factor()
        assert failed
        assert pivot < 0.0
        d = np.full(problem.n, 7.0)
        system.descend(problem.found, problem.layout, d)
        assert d @ problem.dense() @ d == pytest.approx(pivot, rel=1e-8)
        R = problem.reduction()
        np.testing.assert_allclose(R @ np.linalg.lstsq(R, d)[0], d, rtol=0, atol=1e-12)
        problem.diagonal[c] = kept


def test_a_negative_pivot_inside_a_condensed_wall_names_the_wall():
    of = web(MIXED)
    problem = Problem(of, supported(of, "clamped"), couplings(of, "condensed"))
    for wall in (1, 3, 4):
        node = of.edges[of.start[wall], 1]
        kept = problem.diagonal[2 * node + 1]
        weakened(problem, 2 * node + 1)
        failed, pivot = problem.factor()
        assert (failed, *problem.found.place[0]) == (True, wall, 1)
        assert pivot < 0.0
        problem.diagonal[2 * node + 1] = kept
    weakened(problem, 2 * 4)
    assert problem.factor()[0]
    assert problem.found.place[0]["wall"] == -1


@pytest.mark.parametrize("coupled", ["condensed", "some open", "all open", "in contact"])
@pytest.mark.parametrize("pieces", [1, 3, MIXED])
@pytest.mark.parametrize("size", [1.0, 1e6, 1e-6])
def test_a_frame_that_floats_is_not_moved_as_a_whole(size, pieces, coupled):
    """Without mass it has no stiffness against translations: no failure, and loads are borne."""
    of = web(pieces)
    problem = Problem(of, layout_of(of), couplings(of, coupled), mass=0.0)
    problem.contacts = []
    for part in problem.stiffness:
        part *= size
    problem.diagonal[-2:] = size
    problem.layout = problem.layout._replace(scale=7.0 * size)
    assert problem.factor() == (False, 0.0)
    full = problem.dense()
    values = np.linalg.eigvalsh(full)
    assert np.all(np.abs(values[:2]) < 1e-9 * values[-1])
    b = full @ np.random.default_rng(2).uniform(-1, 1, problem.n)
    y = problem.solve(b)
    assert np.abs(y).max() < 1e4
    y[-2] = 0.0
    b[-2] = 0.0
    np.testing.assert_allclose(full @ y, b, rtol=0, atol=1e-7 * size)


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


def test_where_all_joints_are_held_walls_are_solved_one_by_one():
    """No block is left."""
    of = frame([(0, 0), (4, 0), (4, 3)], [(0, 1), (1, 2)], [3, 5])
    joints = np.arange(3)
    held = np.concatenate([2 * joints, 2 * joints + 1, 2 * len(of.points) + joints])
    layout = layout_of(of, held, driven=True)
    problem = Problem(of, layout, np.empty((0, 3), np.int64))
    assert problem.factor() == (False, 0.0)
    assert by_home(problem.found.matrix).size == 0
    assert problem.is_factored(np.random.default_rng(0).uniform(-1, 1, problem.n))


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
