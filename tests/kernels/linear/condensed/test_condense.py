"""Condensation: a wall on its two joints, against dense algebra, for any number of elements."""

import numpy as np
import pytest

from kernels.compile.simd import LANES
from kernels.linear.condensed import condense
from kernels.linear.pivots import ROUNDED, SOFT
from tests.support.kernels.frames import frame, walls_of
from tests.support.kernels.terms import assembled, room

PIECES = [1, 2, 3, 4, 12]
SCALE = 7.0


class Wall:
    """One of four walls, of random stiffness, with ``diagonal`` more inside it."""

    def __init__(self, pieces, seed=0, size=1.0):
        joints = [(0, 0), (3, 0), (4, 3), (8, 3), (8, 6), (5, 7)]
        chain = [(k, k + 1) for k in range(5)]
        of = frame(joints, chain, [2, pieces, pieces, pieces, pieces])
        rng = np.random.default_rng(seed)
        walls = walls_of(of)
        *_, stiffness = room(walls)
        for part in stiffness:
            part[:] = size * rng.uniform(-1, 1, part.shape)
        stiffness.own[[0, 2]] += 5.0 * size
        stiffness.twist[[0, 2]] += 5.0 * size
        self.lane = seed % LANES
        first = 2 + pieces * np.array([2, 0, 3, 1])
        span = slice(first[self.lane], first[self.lane] + pieces)
        inner = walls.dofs[span, 3:].ravel()[:-3]
        outer = np.array([*walls.dofs[span][0, :3], *walls.dofs[span][-1, 3:]])
        self.m, self.size = inner.size, size
        self.dofs = np.random.default_rng(9).permutation(LANES * self.m)  # where they stand
        self.diagonal = size * rng.uniform(0.5, 1.0, (self.m, LANES))
        alone = type(stiffness)(*(np.zeros_like(part) for part in stiffness))
        for part, given in zip(alone, stiffness, strict=True):
            part[:, span] = given[:, span]
        full = assembled(walls, alone, of.rest.size)
        self.full = full[np.ix_([*inner, *outer], [*inner, *outer])]
        self.all_rows = np.full(LANES * 12 * self.m, np.nan)
        self.all_own = np.full(LANES * self.m, np.nan)
        self.all_outer = np.full(LANES * 36, np.nan)
        condense.fill(first, pieces, stiffness, self.all_rows, self.all_outer)

    def _lane(self, array, *shape):
        return array.reshape(*shape, LANES)[..., self.lane]

    @property
    def rows(self):
        """Rows (m, 12) of the wall."""
        return self._lane(self.all_rows, self.m, 12)

    @property
    def own(self):
        """Diagonal (m,) before elimination."""
        return self._lane(self.all_own, self.m)

    @property
    def outer(self):
        """Contribution of the wall to its joints (6, 6)."""
        return self._lane(self.all_outer, 6, 6)

    def dense(self):
        """Hessian (m + 6, m + 6): inner unknowns, then unknowns of the joints."""
        return self.full + np.diag([*self.diagonal[:, self.lane], *np.zeros(6)])

    def eliminate(self):
        """Place of the first negative pivot, and that pivot."""
        scale = (SCALE * self.size,) * 3
        diagonal = np.empty(LANES * self.m)
        diagonal[self.dofs] = self.diagonal.ravel()
        lane, row, pivot = condense.eliminate(
            self.all_rows, self.dofs, diagonal, self.all_own, self.all_outer, scale,
            ROUNDED,
        )  # fmt: skip
        assert lane == (LANES if row < 0 else self.lane)
        return row, pivot

    def forward(self, b, joints):
        """Right side (m,) after the forward substitution; condense it onto ``joints``."""
        inside, carried = np.zeros(LANES * self.m), np.zeros(LANES * 6)
        self._lane(inside, self.m)[:] = b
        self._lane(carried, 6)[:] = joints
        condense.forward(self.all_rows, inside, carried)
        joints[:] = self._lane(carried, 6)
        return self._lane(inside, self.m)

    def backward(self, y, joints, last):
        """Solution (m,) for the right side ``y`` after the forward substitution."""
        inside, moved = np.zeros(LANES * self.m), np.zeros(LANES * 6)
        self._lane(inside, self.m)[:] = y
        self._lane(moved, 6)[:] = joints
        condense.backward(self.all_rows, inside, moved, last)
        return self._lane(inside, self.m)


def mirrored(lower):
    """Symmetric array from its lower half."""
    return np.tril(lower) + np.tril(lower, -1).T


@pytest.mark.parametrize("pieces", PIECES)
def test_fill_writes_the_hessian_of_a_wall(pieces):
    wall = Wall(pieces)
    m, full = wall.m, np.zeros_like(wall.full)
    for k in range(m):
        band = min(6, m - k)
        full[k : k + band, k] = wall.rows[k, :band]
        assert not wall.rows[k, band:6].any()
    full[m:, :m] = wall.rows[:, 6:].T
    full[m:, m:] = np.tril(wall.outer)
    np.testing.assert_allclose(mirrored(full), wall.full, rtol=0, atol=1e-13)


@pytest.mark.parametrize("size", [1.0, 1e9, 1e-9])
@pytest.mark.parametrize("pieces", PIECES)
@pytest.mark.parametrize("seed", range(3))
def test_what_is_left_is_the_schur_complement(seed, pieces, size):
    wall = Wall(pieces, seed, size)
    full, m = wall.dense(), wall.m
    assert wall.eliminate() == (-1, 0.0)
    inner, mixed = full[:m, :m], full[:m, m:]
    expected = full[m:, m:] - mixed.T @ np.linalg.solve(inner, mixed)
    np.testing.assert_allclose(mirrored(wall.outer), expected, rtol=0, atol=1e-12 * size)
    np.testing.assert_allclose(wall.own, np.diag(full)[:m], rtol=1e-14)


@pytest.mark.parametrize("pieces", PIECES)
@pytest.mark.parametrize("seed", range(3))
def test_forward_and_backward_solve_for_what_is_inside(seed, pieces):
    """Forces act on inner unknowns and on joints, and joints move."""
    wall, rng = Wall(pieces, seed), np.random.default_rng(seed)
    full, m = wall.dense(), wall.m
    inner, mixed = full[:m, :m], full[:m, m:]
    wall.eliminate()
    b, joints = rng.uniform(-1, 1, m), rng.uniform(-1, 1, 6)
    carried = joints.copy()
    y = wall.forward(b, carried)
    np.testing.assert_allclose(
        carried, joints - mixed.T @ np.linalg.solve(inner, b), rtol=0, atol=1e-12
    )
    moved = rng.uniform(-1, 1, 6)
    y = wall.backward(y, moved, m)
    np.testing.assert_allclose(inner @ y + mixed @ moved, b, rtol=0, atol=1e-12)


@pytest.mark.parametrize("pieces", [2, 3, 4, 12])
@pytest.mark.parametrize("seed", range(4))
def test_descent_along_a_negative_pivot(seed, pieces):
    """The direction starts at rest at the first negative pivot: d^T A d is that pivot."""
    wall = Wall(pieces, seed)
    bad = int(np.random.default_rng(seed).integers(0, wall.m))
    wall.diagonal[bad, wall.lane] -= 1.5 * wall.dense()[bad, bad]
    failed, pivot = wall.eliminate()
    assert 0 <= failed <= bad
    assert pivot < 0.0
    d = np.zeros(wall.m)
    d[failed] = 1.0
    d = wall.backward(d, np.zeros(6), failed)
    assert d @ wall.dense()[: wall.m, : wall.m] @ d == pytest.approx(pivot, rel=1e-9)
    assert not d[failed + 1 :].any()


def test_what_has_no_stiffness_inside_has_a_little():
    """A node that nothing holds across: it is given a share of the scale."""
    wall = Wall(2)
    for part in (wall.rows, wall.full):
        part[:] = 0.0
    wall.rows[0, 0] = wall.full[0, 0] = 3.0
    wall.diagonal[:] = 0.0
    assert wall.eliminate() == (-1, 0.0)
    y = wall.backward(wall.forward(np.full(3, 6.0), np.zeros(6)), np.zeros(6), 3)
    little = 6.0 / (SOFT * SCALE)
    np.testing.assert_allclose(y, [2.0, little, little])


def test_nan_fails():
    wall = Wall(3)
    wall.rows[1, 0] = np.nan
    failed, pivot = wall.eliminate()
    assert failed == 1
    assert np.isnan(pivot)
