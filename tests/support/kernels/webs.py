"""Frames of random stiffness, supported and coupled in several ways: dense and factored."""

import numpy as np

from kernels.linear.condensed import analysis, block_matrix, system
from tests.support.kernels.frames import frame, layout_of, walls_of
from tests.support.kernels.terms import assembled, room

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
    return 2 * nodes, 2 * nodes + 1, 2 * len(of.points) + nodes


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
    """Positive definite in all elements."""
    *_, stiffness = room(walls_of(of))
    for part in stiffness:
        part[:] = rng.uniform(-1, 1, part.shape)
    stiffness.own[[0, 2]] += 5.0
    stiffness.twist[[0, 2]] += 5.0
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
        return system.factor(self.found, self.layout, self.stiffness, False)

    def solve(self, b):
        """Solution by coordinate after the factor."""
        y = b.copy()
        system.solve(self.found, self.layout, y)
        return y

    def reduction(self):
        """Matrix (n, free) from unknowns to coordinates."""
        leader = self.layout.leader
        free = [c for c in np.unique(leader[leader >= 0]) if c != self.layout.driven]
        return (leader[:, None] == np.array(free)).astype(float)

    def is_factored(self, b, rtol=1e-9):
        """Whether the solution for ``b`` agrees with dense algebra."""
        R = self.reduction()
        expected = R @ np.linalg.solve(R.T @ self.dense() @ R, R.T @ b)
        return np.allclose(self.solve(b), expected, rtol=0, atol=rtol * np.abs(expected).max())


def _put(full, i, j, value):
    full[i, j] += value
    if i != j:
        full[j, i] += value
